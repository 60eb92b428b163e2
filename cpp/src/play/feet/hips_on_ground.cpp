// SPDX-License-Identifier: MIT
#include "feet/hips_on_ground.hpp"

#include <algorithm>
#include <cmath>

#include "feet/standing_leg.hpp"

namespace fragmotion {
namespace {

constexpr double kRising = 0.3;  // s in which they come up again

// How much of the way from one place to another a place is.
double part_between(const Vector2& from, const Vector2& to, const Vector2& place) {
  const Vector2 way = to - from;
  const double square = way.squaredNorm();
  return square > 0 ? std::clamp(dot(place - from, way) / square, 0.0, 1.0) : 0;
}

// A value's distance from a target that moves evenly, and its rate, after a time: a critically damped spring.
void settle(double& off, double& rate, double quickness, double seconds) {
  const double decay = std::exp(-quickness * seconds), push = rate + quickness * off;
  off = decay * (off + seconds * push);
  rate = decay * (rate - seconds * quickness * push);
}

}  // namespace

double level_between(const FeetOnGround& feet, const Vector2& place) {
  const int side = feet[1].swing_time() < feet[0].swing_time() ? 1 : 0;
  const Footing &under = feet[side].last(), &behind = feet[1 - side].last(), &ahead = feet[1 - side].next();
  const double back = part_between(under.place, behind.place, place),
               front = part_between(under.place, ahead.place, place), away = std::max(back, front);
  if (away == 0) return under.at(place);
  const double ends = (back * behind.at(place) + front * ahead.at(place)) / (back + front);
  return (1 - away) * under.at(place) + away * ends;
}

void HipsOnGround::advance(const Vector2& place, const FeetOnGround& feet, double seconds) {
  const double target = level_between(feet, place);
  if (fresh_ || seconds <= 0) {
    if (fresh_) level_ = target;
  } else {
    const double before = level_between(feet, place_), pace = (target - before) / seconds;
    double off = level_ - before, rate = speed_ - pace;
    settle(off, rate, kHipsFollow, seconds);
    level_ = target + off;
    speed_ = pace + rate;
  }
  place_ = place;
  fresh_ = false;
}

void HipsOnGround::sink(double now, double soon, double due, double seconds) {
  due = std::max(due, kLoading);
  const double at_once = (now - sunk_.value) / kLoading, later = (soon - sunk_.value) / due;
  if (at_once <= 0 && later <= 0) {
    sunk_.advance(std::max(now, soon), kRising, seconds);
  } else if (at_once > later) {
    sunk_.advance(now, kLoading, seconds);
  } else {
    sunk_.advance(soon, due, seconds);
  }
}

}  // namespace fragmotion

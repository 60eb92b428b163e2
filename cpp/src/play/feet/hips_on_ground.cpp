// SPDX-License-Identifier: MIT
#include "feet/hips_on_ground.hpp"

#include <algorithm>
#include <cmath>

#include "feet/standing_leg.hpp"

namespace fragmotion {
namespace {

// How much of the way from one place to another a place is.
double part_between(const Vector2& from, const Vector2& to, const Vector2& place) {
  const Vector2 way = to - from;
  const double square = way.squaredNorm();
  return square > 0 ? std::clamp(dot(place - from, way) / square, 0.0, 1.0) : 0;
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

// A critically damped spring on a target that moves evenly.
void HipsOnGround::advance(const Vector2& place, const FeetOnGround& feet, double seconds) {
  const double target = level_between(feet, place);
  if (fresh_) {
    level_ = target;
  } else if (seconds > 0) {
    const double before = level_between(feet, place_), pace = (target - before) / seconds, off = level_ - before,
                 rate = speed_ - pace, decay = std::exp(-kHipsFollow * seconds), push = rate + kHipsFollow * off;
    level_ = target + decay * (off + seconds * push);
    speed_ = pace + decay * (rate - seconds * kHipsFollow * push);
  }
  place_ = place;
  fresh_ = false;
}

void HipsOnGround::sink(double now, double soon, double due, double rising, double seconds) {
  due = std::max(due, kLoading);
  const double at_once = (now - sunk_.value) / kLoading, later = (soon - sunk_.value) / due;
  if (at_once <= 0 && later <= 0) {
    sunk_.advance(std::max(now, soon), rising, seconds);
  } else if (at_once > later) {
    sunk_.advance(now, kLoading, seconds);
  } else {
    sunk_.advance(soon, due, seconds);
  }
}

}  // namespace fragmotion

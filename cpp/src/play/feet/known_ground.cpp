// SPDX-License-Identifier: MIT
#include "feet/known_ground.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace fragmotion {
namespace {

constexpr double kAtEdge = 0.1;  // m of a character of 1.8 m that a sole is better moved

}  // namespace

bool KnownGround::agree(const Known& a, const Known& b, double metre) {
  if (!a.exists || !b.exists) return a.exists == b.exists;
  return std::abs(a.plane.at(b.plane.place) - b.plane.height) < kUneven * metre &&
         std::abs(b.plane.at(a.plane.place) - a.plane.height) < kUneven * metre;
}

std::optional<Footing> KnownGround::ask(const Vector2& place, GroundProbe& probe) {
  const std::optional<Footing> found = probe.at(place);
  known_[next_] = {found.value_or(Footing{place, 0, Vector2::Zero()}), found.has_value()};
  next_ = (next_ + 1) % kMost;
  count_ = std::max(count_, next_ == 0 ? kMost : next_);
  return found;
}

std::optional<Footing> KnownGround::at(const Vector2& place, const Along& along, GroundProbe& probe) {
  struct Near {
    const Known* known = nullptr;
    double square = std::numeric_limits<double>::infinity(), ahead = 0, aside = 0;
  };
  Near behind, before;
  const double metre = probe.metre();
  for (int i = 0; i < count_; ++i) {
    const Vector2 off = known_[i].plane.place - place;
    const double square = off.x() * off.x() + off.y() * off.y(),
                 ahead = off.x() * along.way.x() + off.y() * along.way.y();
    Near& side = ahead > 0 ? before : behind;
    if (square < side.square)
      side = {&known_[i], square, std::abs(ahead), std::abs(off.x() * along.way.y() - off.y() * along.way.x())};
  }
  const Near& nearest = behind.square < before.square ? behind : before;
  const bool between = behind.known && before.known && behind.ahead + before.ahead <= kApart * metre,
             same = nearest.square < kThere * metre * kThere * metre;
  const auto level_with = [&](const Near& near) { return near.aside <= along.beside * metre; };
  const bool sure =
      same || (between ? agree(*behind.known, *before.known, metre) && level_with(behind) && level_with(before)
                       : nearest.known && nearest.ahead < kTried * metre && level_with(nearest));
  if (!sure && probe.may_ask()) return ask(place, probe);
  if (nearest.known == nullptr || !nearest.known->exists) return std::nullopt;
  return Footing{place, nearest.known->plane.at(place), nearest.known->plane.slope};
}

double KnownGround::edges(const Sole& sole, GroundProbe& probe) {
  const Vector2 heel = sole.heel.head<2>(), tip = sole.tip.head<2>(), along = (tip - heel).normalized();
  const std::optional<Footing> ground = at(sole.place(), {along, kThere}, probe);
  if (count_ == 0) return 0;
  if (!ground) return kInTheWay;
  const Vector2 beyond = kUneven * probe.metre() * along;
  const auto edge = [&](const Vector2& place) {
    const std::optional<Footing> there = at(place, {along, kThere}, probe);
    const double higher = there ? there->height - ground->at(place) : 0;
    return higher > kUneven * probe.metre() ? kInTheWay : higher < -kUneven * probe.metre() ? kAtEdge : 0;
  };
  return edge(heel) + edge(heel - beyond) + edge(tip + beyond) + edge(tip);
}

double KnownGround::over(const Sole& sole, double lower, const Footing& plane, const Along& along, GroundProbe& probe) {
  double most = 0;
  for (const Vector3& point : sole.points()) {
    const std::optional<Footing> ground = at(point.head<2>(), along, probe);
    if (!ground) continue;
    most = std::max(most, ground->height - plane.at(point.head<2>()) - std::max(0.0, point.z() - lower));
  }
  return most;
}

}  // namespace fragmotion

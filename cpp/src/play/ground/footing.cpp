// SPDX-License-Identifier: MIT
#include "ground/footing.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/ranges.hpp"

namespace fragmotion {
namespace {

const double kSteepest = std::tan(35 * kPi / 180);               // that a foot is turned
constexpr double kLeastNormal = 1e-100;                          // length of one
constexpr double kEdge = 0.05;                                   // m that ground is beside a plane, at an edge
constexpr double kBeyond = 0.04;                                 // m beyond the ends of a sole that are to be free
constexpr double kOver = 0.15, kRatherOver = 0.1, kNear = 0.05;  // m that a sole is better moved

// Squares of a normal's length are numbers that it can be divided by, and heights are still told apart.
bool is_ground(const GroundPoint& point) {
  const double length = point.normal.cwiseAbs().maxCoeff();
  return std::abs(point.height) <= kFarthestPlace && point.normal.allFinite() && length >= kLeastNormal &&
         length <= 1 / kLeastNormal;
}

// How much ground of this normal rises along x and y.
Vector2 slope_of(const Vector3& normal) {
  const double up = std::abs(normal.z()), side = normal.head<2>().norm();
  if (side < 1e-9 * up) return Vector2::Zero();
  const double sign = normal.z() < 0 ? 1 : -1;
  return sign * std::min(kSteepest, side / std::max(up, 1e-9 * side)) / side * normal.head<2>();
}

}  // namespace

std::optional<GroundPoint> GroundProbe::at(const Vector2& place) const {
  std::optional<GroundPoint> point = (*ground_)({place.x(), place.y(), above_});
  return point && is_ground(*point) ? point : std::nullopt;
}

std::optional<Footing> GroundProbe::under(const Sole& sole) const {
  Footing footing{sole.place(), -std::numeric_limits<double>::infinity(), Vector2::Zero()};
  std::array<std::optional<GroundPoint>, 3> found;
  int count = 0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    found[i] = at(sole.points()[i].head<2>());
    if (!found[i]) continue;
    footing.slope += slope_of(found[i]->normal);
    ++count;
  }
  if (count == 0) return std::nullopt;
  footing.slope /= count;
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (!found[i]) continue;
    const Vector2 from_ball = sole.points()[i].head<2>() - footing.place;
    footing.height = std::max(footing.height, found[i]->height - dot(footing.slope, from_ball));
  }
  return footing;
}

double GroundProbe::edges(const Sole& sole, bool descends) const {
  const std::optional<GroundPoint> ground = at(sole.place());
  if (!ground) return kInTheWay;
  const Vector2 slope = slope_of(ground->normal), along = (sole.tip - sole.heel).head<2>().normalized();
  const auto edge = [&](const Vector2& place, double overhanging) {
    const std::optional<GroundPoint> there = at(place);
    const double higher = there ? there->height - ground->height - dot(slope, place - sole.place()) : 0;
    return higher > kEdge ? kInTheWay : higher < -kEdge ? overhanging : 0;
  };
  const Vector2 heel = sole.heel.head<2>(), tip = sole.tip.head<2>();
  return edge(heel, descends ? kOver : kRatherOver) + edge(heel - kBeyond * along, kNear) +
         edge(sole.place() + kBeyond * along, kInTheWay) + edge(tip + kBeyond * along, kNear) +
         edge(tip, descends ? kRatherOver : kOver);
}

double GroundProbe::over(const Sole& sole, double lower, const Footing& plane) const {
  double most = 0;
  for (const Vector3& point : sole.points()) {
    const std::optional<GroundPoint> ground = at(point.head<2>());
    if (!ground) continue;
    most = std::max(most, ground->height - plane.at(point.head<2>()) - std::max(0.0, point.z() - lower));
  }
  return most;
}

}  // namespace fragmotion

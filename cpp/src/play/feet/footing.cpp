// SPDX-License-Identifier: MIT
#include "feet/footing.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/ranges.hpp"
#include "base/rounding.hpp"

namespace fragmotion {
namespace {

const double kSteepest = std::tan(35 * kPi / 180);  // that a foot is turned

// Squares of a normal's length are numbers that it can be divided by, and heights are still told apart.
bool is_ground(const GroundPoint& point) {
  return std::abs(point.height) <= kFarthestPlace && std::isnormal(point.normal.squaredNorm());
}

// How much ground of this normal rises along x and y.
Vector2 slope_of(const Vector3& normal) {
  const double up = std::abs(normal.z()), side = normal.head<2>().norm();
  if (side < kRounding * up) return Vector2::Zero();
  const double sign = normal.z() < 0 ? 1 : -1;
  return sign * std::min(kSteepest, side / std::max(up, kRounding * side)) / side * normal.head<2>();
}

}  // namespace

std::optional<GroundPoint> GroundProbe::ask(const Vector2& place) {
  --left_;
  std::optional<GroundPoint> point = (*ground_)({place.x(), place.y(), above_});
  return point && is_ground(*point) ? point : std::nullopt;
}

std::optional<Footing> GroundProbe::at(const Vector2& place) {
  const std::optional<GroundPoint> point = ask(place);
  return point ? std::optional(Footing{place, point->height, slope_of(point->normal)}) : std::nullopt;
}

std::optional<Footing> plane_under(const Sole& sole, const std::array<std::optional<Footing>, 3>& points) {
  Footing footing{sole.place(), -std::numeric_limits<double>::infinity(), Vector2::Zero()};
  int count = 0;
  for (const std::optional<Footing>& point : points) {
    if (!point) continue;
    footing.slope += point->slope;
    ++count;
  }
  if (count == 0) return std::nullopt;
  footing.slope /= count;
  for (const std::optional<Footing>& point : points) {
    if (point)
      footing.height = std::max(footing.height, point->height - dot(footing.slope, point->place - footing.place));
  }
  return footing;
}

}  // namespace fragmotion

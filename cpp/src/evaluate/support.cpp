// SPDX-License-Identifier: MIT
#include "fragmotion/evaluate/support.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "evaluate/tracks.hpp"

namespace fragmotion {
namespace {

constexpr double kHalfWindow = 0.125;  // s to each side, which an acceleration is of
constexpr double kTolerance = 3;       // m/s^2
constexpr double kFootLength = 0.27;   // m

using Places = std::vector<Vector2>;

// The second derivative at `center` of the least-squares parabola through frames center - half .. center + half.
Vector3 acceleration(const std::vector<Vector3>& path, int center, int half, double rate) {
  double count = 0, squares = 0, fourths = 0;
  Vector3 sum = Vector3::Zero(), weighted = Vector3::Zero();
  for (int i = -half; i <= half; ++i) {
    const double square = i * i;
    count += 1;
    squares += square;
    fourths += square * square;
    sum += path[center + i];
    weighted += square * path[center + i];
  }
  return 2 * rate * rate * (count * weighted - squares * sum) / (count * fourths - squares * squares);
}

double cross(const Vector2& a, const Vector2& b) { return a.x() * b.y() - a.y() * b.x(); }

// The corners of the convex hull, counter-clockwise (Andrew's monotone chain).
Places convex_hull(Places points) {
  if (points.empty()) return points;
  std::sort(points.begin(), points.end(),
            [](const Vector2& a, const Vector2& b) { return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y(); });
  Places hull;
  const auto extend = [&](const Vector2& point, std::size_t least) {
    while (hull.size() >= least && cross(hull.back() - hull[hull.size() - 2], point - hull.back()) <= 0) {
      hull.pop_back();
    }
    hull.push_back(point);
  };
  for (const Vector2& point : points) extend(point, 2);
  const std::size_t lower = hull.size() + 1;
  for (auto point = points.rbegin() + 1; point < points.rend(); ++point) extend(*point, lower);
  if (hull.size() > 1) hull.pop_back();
  return hull;
}

double distance_to_segment(const Vector2& point, const Vector2& begin, const Vector2& end) {
  const Vector2 way = end - begin;
  const double length = way.squaredNorm();
  const double at = length > 0 ? std::clamp((point - begin).dot(way) / length, 0.0, 1.0) : 0;
  return (point - begin - at * way).norm();
}

// 0 within it.
double distance_to_hull(const Vector2& point, const Places& hull) {
  bool inside = hull.size() > 2;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Vector2 &begin = hull[i], &end = hull[(i + 1) % hull.size()];
    inside = inside && cross(end - begin, point - begin) >= 0;
    nearest = std::min(nearest, distance_to_segment(point, begin, end));
  }
  return inside ? 0 : nearest;
}

// Balls and heels of the feet that stand, or, where none does, of those near the floor, in frames first .. last.
Places standing_points(const BodyTrack& track, int first, int last) {
  Places stand, low;
  for (std::size_t side = 0; side < track.feet.size(); ++side) {
    const FootPath& foot = track.feet[side];
    const FootHeights& floor = track.floors[side];
    for (int f = first; f <= last; ++f) {
      if (track.stands[side][f]) stand.insert(stand.end(), {foot.ball[f].head<2>(), foot.heel[f].head<2>()});
      if (foot.ball[f].z() - floor.ball < kLow) low.emplace_back(foot.ball[f].head<2>());
      if (foot.heel[f].z() - floor.heel < kLow) low.emplace_back(foot.heel[f].head<2>());
    }
  }
  return stand.empty() ? low : stand;
}

// Whether a force for each kg of a body whose centre is at `center`, over a ground at 0, can come from the hull.
bool bears(const Places& hull, const Vector3& center, const Vector3& force) {
  if (force.norm() <= kTolerance) return true;
  if (hull.empty() || force.z() <= 0) return false;
  const Vector2 zero_moment = center.head<2>() - center.z() / force.z() * force.head<2>();
  return distance_to_hull(zero_moment, hull) <= kFootLength;
}

}  // namespace

double Support::unsupported_share() const {
  return judged > 0 ? static_cast<double>(unsupported) / judged : std::numeric_limits<double>::quiet_NaN();
}

void Support::add(const Support& other) {
  judged += other.judged;
  unsupported += other.unsupported;
}

Support find_support(const BodyTrack& track) {
  if (!track.has_feet()) return {};
  const int half = track.frames_in(kHalfWindow);
  const Vector3 ground{0, 0, std::min(track.floors[0].ball, track.floors[1].ball)};
  Support support;
  for (int f = half; f + half < track.frames(); ++f) {
    const Vector3 force = acceleration(track.center, f, half, track.rate) + Vector3{0, 0, kGravity};
    const Places hull = convex_hull(standing_points(track, f - half, f + half));
    ++support.judged;
    if (!bears(hull, track.center[f] - ground, force)) ++support.unsupported;
  }
  return support;
}

}  // namespace fragmotion

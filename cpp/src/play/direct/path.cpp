// SPDX-License-Identifier: MIT
#include "direct/path.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "base/rounding.hpp"
#include "base/take_limits.hpp"

namespace fragmotion {
namespace {

void check(const std::vector<Vector2>& points, const std::vector<double>& speeds) {
  if (points.size() < 2)
    throw std::invalid_argument("a path needs two points, and has " + std::to_string(points.size()));
  if (points.size() > kMostPathPoints) {
    throw std::invalid_argument("a path may have a million points, and has " + std::to_string(points.size()));
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!(points[i].array().abs() <= kFarthestBody).all())
      throw std::invalid_argument("point " + std::to_string(i) + " of the path is not within 1e6 m");
  }
  if (!speeds.empty() && speeds.size() != points.size()) {
    throw std::invalid_argument("the path has " + std::to_string(points.size()) + " points and " +
                                std::to_string(speeds.size()) + " speeds");
  }
  for (std::size_t i = 0; i < speeds.size(); ++i) {
    if (!(speeds[i] > 0 && speeds[i] <= kFastestBody))
      throw std::invalid_argument("the speed at point " + std::to_string(i) +
                                  " of the path must be over 0 to 1000 m/s");
  }
}

}  // namespace

Path::Path(const std::vector<Vector2>& points, bool closed, const std::vector<double>& speeds) : closed_(closed) {
  check(points, speeds);
  const std::size_t count = points.size() + (closed ? 1 : 0);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t at = i % points.size();
    const double step = i == 0 ? 0 : (points[at] - points_.back()).norm();
    if (i > 0 && !(step > kRounding)) continue;
    ways_.push_back(i == 0 ? 0 : ways_.back() + step);
    points_.push_back(points[at]);
    if (!speeds.empty()) speeds_.push_back(speeds[at]);
  }
  if (!(length() > kFileRounding)) {
    throw std::invalid_argument("the path has no length on the ground: its points lie above one another");
  }
}

Path Path::closed() const { return closed_ ? *this : Path(points_, true, speeds_); }

double Path::fastest() const { return *std::max_element(speeds_.begin(), speeds_.end()); }

double Path::within(double way) const { return closed_ ? way - length() * std::floor(way / length()) : way; }

std::size_t Path::segment(double way) const {
  const auto after = std::upper_bound(ways_.begin(), ways_.end(), way);
  const auto index = static_cast<std::size_t>(std::max<std::ptrdiff_t>(after - ways_.begin() - 1, 0));
  return std::min(index, ways_.size() - 2);
}

Vector2 Path::place(double way) const {
  const double at = within(way);
  const std::size_t i = segment(at);
  const double share = (at - ways_[i]) / (ways_[i + 1] - ways_[i]);
  return points_[i] + share * (points_[i + 1] - points_[i]);
}

Vector2 Path::direction(double way, double span) const {
  const Vector2 here = place(way), behind = place(way + span / 2);
  const Vector2 across = behind - place(way - span / 2), away = behind - here;
  if (across.norm() > 1e-6 * span) return across.normalized();
  if (away.norm() > 1e-6 * span) return away.normalized();
  const std::size_t i = segment(within(way));
  return (points_[i + 1] - points_[i]).normalized();
}

double Path::speed(double way) const {
  const double at = std::clamp(within(way), 0.0, length());
  const std::size_t i = segment(at);
  const double share = (at - ways_[i]) / (ways_[i + 1] - ways_[i]);
  return speeds_[i] + share * (speeds_[i + 1] - speeds_[i]);
}

double Path::nearest(const Vector2& point, double from, double to) const {
  double best = from, least = (place(from) - point).norm();
  for (double begin = from; begin < to;) {
    const double at = within(begin);
    const std::size_t i = segment(at);
    const bool last = i + 2 == ways_.size();
    const double left = last && !closed_ ? to - begin : ways_[i + 1] - at;
    const double end = std::min(to, begin + std::max(left, kRounding * std::max(1.0, std::abs(begin))));
    const Vector2 along = (points_[i + 1] - points_[i]) / (ways_[i + 1] - ways_[i]);
    const double way = begin + std::clamp(dot(along, point - place(begin)), 0.0, end - begin);
    const double distance = (place(way) - point).norm();
    if (distance < least) {
      best = way;
      least = distance;
    }
    begin = end;
  }
  return best;
}

}  // namespace fragmotion

// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "base/types.hpp"

namespace fragmotion {

/// The most points that a path may have.
constexpr std::size_t kMostPathPoints = 1000000;

/// A way over the ground: straight lines from point to point. Places on it are told by the way from its beginning, m;
/// round a closed path this goes on lap after lap, and beyond the ends of an open one it leads straight on.
class Path {
 public:
  /// `points` [N], m; `closed`: the last point leads back to the first; `speeds` [N], m/s: how fast to go at each
  /// point, or empty. Throws std::invalid_argument on fewer than two points, on a path of no length, on what is not
  /// within 1e6 m, and on speeds that are not as many as the points or not over 0 and at most 1000.
  explicit Path(const std::vector<Vector2>& points, bool closed = false, const std::vector<double>& speeds = {});

  double length() const { return ways_.back(); }
  bool is_closed() const { return closed_; }
  bool has_speeds() const { return !speeds_.empty(); }
  /// The same, with the last point leading back to the first.
  Path closed() const;

  Vector2 place(double way) const;
  /// The unit vector from `span` / 2 before to `span` / 2 behind a place; where the path comes back on itself just
  /// there, the one that leads away from it.
  Vector2 direction(double way, double span) const;
  /// How fast to go, m/s, of a path with speeds.
  double speed(double way) const;
  /// The greatest of its speeds, m/s.
  double fastest() const;
  /// The place nearest to `point` between two ways; the first on a tie. So a figure of eight is not left at its
  /// crossing.
  double nearest(const Vector2& point, double from, double to) const;

 private:
  double within(double way) const;
  std::size_t segment(double way) const;

  std::vector<Vector2> points_;  // without repeated ones; of a closed path the first stands at the end, too
  std::vector<double> ways_;     // m from the beginning
  std::vector<double> speeds_;
  bool closed_;
};

}  // namespace fragmotion

// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <vector>

#include "base/random.hpp"
#include "base/types.hpp"
#include "direct/area_edge.hpp"

namespace fragmotion {

/// A triangle's corners, m, and how much each is painted; between them the paint is linear.
struct PaintedTriangle {
  std::array<Vector3, 3> corners;
  std::array<double, 3> paint{};
};

/// Places on a painted surface: the more it is painted, the likelier. Throws std::invalid_argument unless corners are
/// finite, paint is 0 to 1, and something is painted.
class PaintedArea {
 public:
  explicit PaintedArea(std::vector<PaintedTriangle> triangles);

  /// A place on it.
  Vector3 draw(Random& random) const;

  /// So many places, seen from above no two of them nearer than `spacing`, m; fewer where 400 draws in a row for each
  /// place that is there find no room for another. Where there are enough of them, none is nearer to the edge than
  /// `room`, m.
  std::vector<Vector3> draw_apart(Random& random, int count, double spacing, double room = 0) const;

  /// For each start so many places one after another, [starts x count]: the straight way to each from the one before is
  /// on the paint, seen from above, and comes no nearer to its edge than `room`, m, unless it begins there. Where 400
  /// draws find none it is the way that is the furthest from the edge, and where none is on the paint, none.
  std::vector<Vector3> draw_ways(Random& random, const std::vector<Vector3>& starts, int count, double room = 0) const;

  /// The edge of what is painted at all.
  const AreaEdge& edge() const { return edge_; }

 private:
  Vector3 draw_way(Random& random, const Vector3& from, double room) const;

  std::vector<PaintedTriangle> triangles_;
  std::vector<double> sums_;  // of sizes, were all of a triangle painted as its most painted corner, up to each
  AreaEdge edge_;
};

}  // namespace fragmotion

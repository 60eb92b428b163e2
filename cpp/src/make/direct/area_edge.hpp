// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "base/types.hpp"

namespace fragmotion {

/// Three corners, m, seen from above.
using FlatTriangle = std::array<Vector2, 3>;

/// The edge of all that triangles cover together, seen from above. They may overlap, and what stands upright covers
/// nothing.
class AreaEdge {
 public:
  AreaEdge() = default;
  explicit AreaEdge(const std::vector<FlatTriangle>& triangles);

  /// Whether a place is within.
  bool holds(const Vector2& place) const;
  /// How far the edge is from a place, m; less than 0 without.
  double room(const Vector2& place) const;
  /// How near a straight way comes to the edge, m; 0 where it crosses it.
  double room(const Vector2& from, const Vector2& to) const;

  /// What of the edge one has beside itself, seen from within: of each stretch the place that is square across, and the
  /// corners about which it goes. From without it is the nearest place alone.
  struct Beside {
    std::vector<Vector2> across, corners;
  };
  Beside beside(const Vector2& place) const;

 private:
  struct Stretch {
    Vector2 from, to;      // what is covered lies to the left
    bool juts_out = true;  // at its end, into what is covered
  };

  std::vector<Stretch> stretches_;
};

}  // namespace fragmotion

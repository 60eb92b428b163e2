// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "ground/feet_ahead.hpp"
#include "ground/ground.hpp"

namespace fragmotion {

/// The plane that a sole stands on.
struct Footing {
  Vector2 place = Vector2::Zero();  ///< Where it is at `height`, m.
  double height = 0;
  Vector2 slope = Vector2::Zero();  ///< How much it rises along x and y.

  double at(const Vector2& there) const { return height + dot(slope, there - place); }
};

/// What feet ask the ground, from one height downward.
class GroundProbe {
 public:
  static constexpr double kInTheWay = 1;  ///< m: edges() of a sole that reaches into a step.

  GroundProbe(const Ground& ground, double above) : ground_(&ground), above_(above) {}

  std::optional<GroundPoint> at(const Vector2& place) const;
  /// The plane that touches the ground under a sole and is nowhere below it, as steep as the ground is on average, and
  /// at most as a foot is turned. None where there is no ground.
  std::optional<Footing> under(const Sole& sole) const;
  /// How far a sole is better moved than set where it is, m: 0 unless ground of another height than that under its ball
  /// is under its ends or just beyond them. On the way up rather the heel is over an edge, on the way down the tip.
  double edges(const Sole& sole, bool descends) const;
  /// How far the ground reaches over a plane into a sole that is so much lower than captured, m; 0 where it does not.
  double over(const Sole& sole, double lower, const Footing& plane) const;

 private:
  const Ground* ground_;
  double above_;
};

}  // namespace fragmotion

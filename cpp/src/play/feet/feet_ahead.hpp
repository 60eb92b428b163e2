// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "motion/contacts.hpp"

namespace fragmotion {

// Lengths are those of a character of 1.8 m.
/// m over its floor within which a foot comes down to it.
constexpr double kLanding = 0.06;
/// s in which a foot gets to a height that is not its motion's.
constexpr double kSettles = 0.05;
/// s that are looked ahead at most.
constexpr double kLookedAhead = 0.8;

/// Points of a sole on level ground at height 0, under heel, ball and tip of a foot; z is how high each is, m.
struct Sole {
  Vector3 heel = Vector3::Zero(), ball = Vector3::Zero(), tip = Vector3::Zero();

  std::array<Vector3, 3> points() const { return {heel, ball, tip}; }
  Vector2 place() const { return ball.head<2>(); }
  /// How high its lowest point is.
  double height() const { return std::min(heel.z(), ball.z()); }
  Sole moved(const Vector2& by) const {
    Sole sole = *this;
    for (Vector3* point : {&sole.heel, &sole.ball, &sole.tip}) point->head<2>() += by;
    return sole;
  }
};

/// What a foot does on level ground: where it is now and, unless it stands, its way to where it stands next.
struct FootAhead {
  static constexpr std::size_t kPoints = 6;

  bool stands = false;
  FootHeights floor;  ///< Of ball and heel where the foot stands.
  Sole now;
  double due = 0;                  ///< s until it stands.
  std::array<Sole, kPoints> way;   ///< At equal times until then; the last is where it stands, at rest.
  Vector3 hips = Vector3::Zero();  ///< When it comes to stand: of the body,
  Vector3 hip = Vector3::Zero(), ankle = Vector3::Zero();  ///< and the ends of its leg.

  /// Where it stands, or is to stand, at rest.
  const Sole& landing() const { return way.back(); }
};

using FeetAhead = std::array<FootAhead, 2>;  ///< Left, right.

}  // namespace fragmotion

// SPDX-License-Identifier: MIT
#pragma once

#include "skeleton/kinematics.hpp"

namespace fragmotion {

/// What turns the ground plane by a heading.
inline PlaneTurn turn_by(double heading) { return PlaneTurn(heading); }

/// How the world lies that a player plays in to the world that the game sees: turned about the up axis, and moved.
struct Shift {
  bool none = true;
  double heading = 0, lift = 0;
  Vector2 offset = Vector2::Zero();

  Vector3 place(const Vector3& inside) const;
  Vector3 direction(const Vector3& inside) const;
  Vector3 place_inside(const Vector3& outside) const;
  Vector3 direction_inside(const Vector3& outside) const;
  CharacterFrame frame(const CharacterFrame& inside) const;
};

}  // namespace fragmotion

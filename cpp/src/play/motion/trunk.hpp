// SPDX-License-Identifier: MIT
#pragma once

#include "skeleton/skeleton.hpp"

namespace fragmotion {

/// The bones of the upper body; -1 where the skeleton has none.
struct Trunk {
  int base = -1;   ///< The lowest bone of the spine: what is above the legs.
  int chest = -1;  ///< The bone that both arms hang from.
  int head = -1;   ///< Above the chest.

  explicit Trunk(const Skeleton& skeleton);
};

/// Of the trunk's turn that the head turns back.
constexpr double kHeadBack = 0.5;

/// The bones of the spine of a trunk that has one.
int spine_bones(const Skeleton& skeleton, const Trunk& trunk);

/// How a bone below the hips is turned in the world by a pose's rotations [bones, 4].
Quaternion world_turn(const Skeleton& skeleton, int bone, const double* rotations);

/// Turns a bone of a pose's rotations [bones, 4] by an angle, rad, about an axis that is given in the world; its
/// children go along.
void turn_bone(const Skeleton& skeleton, int bone, const Vector3& axis, double angle, double* rotations);

/// Turns the trunk, each bone of its spine by as much, so that the chest turns by the angle, and the head back by
/// kHeadBack of it. Does nothing where there is no spine.
void turn_spine(const Skeleton& skeleton, const Trunk& trunk, const Vector3& axis, double angle, double* rotations);

}  // namespace fragmotion

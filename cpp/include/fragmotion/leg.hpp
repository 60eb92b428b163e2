// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "fragmotion/kinematics.hpp"

namespace fragmotion {

/// A leg by its roles: any chain of bones from a thigh to a foot with a joint between them. `knee` is -1 where there is
/// none.
struct Leg {
  int thigh = -1, knee = -1, foot = -1, toe = -1;
  int above_foot = -1;  ///< The foot's parent.

  bool exists() const { return knee >= 0; }
};

/// The left and the right leg. The knee is the joint that divides a leg most evenly.
Leg left_leg(const Skeleton& skeleton);
Leg right_leg(const Skeleton& skeleton);

/// World places and rotations of all bones of one pose, which legs are bent in.
struct PosedBones {
  std::vector<Vector3> heads;
  std::vector<Quaternion> rotations;

  explicit PosedBones(int bones) : heads(bones), rotations(bones) {}
};

/// The ball of a leg's foot: the toe's head, or the foot's tip.
Vector3 ball(const Skeleton& skeleton, const Leg& leg, const PosedBones& posed);

/// How far the hips must sink for the leg to reach `ankle`, m: 0 where it does, infinite where no sinking helps.
double sinking(const Leg& leg, const PosedBones& posed, const Vector3& ankle);

/// Two-bone inverse kinematics: bends the knee, to the front of a character that faces `heading`, and swings the thigh,
/// so that the foot's head comes to `ankle` or as near as the leg is long. Foot and toe keep their world rotations.
/// Writes the local `rotations` [bones, 4] of thigh, knee and foot; `posed` stays as it was before.
void reach(const Skeleton& skeleton, const Leg& leg, const PosedBones& posed, const Vector3& ankle, double heading,
           double* rotations);

}  // namespace fragmotion

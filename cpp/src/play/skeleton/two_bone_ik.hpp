// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "skeleton/kinematics.hpp"

namespace fragmotion {

/// Of the length of a leg or an arm, and the sine of its bend: a knee or an elbow that is less off the line between its
/// ends does not tell to where it bends.
constexpr double kBends = 0.05;

/// Of the length of a leg or an arm: so far it reaches as it is asked to, and beyond that it follows ever less.
constexpr double kTires = 0.965;

/// A leg by its roles: any chain of bones below the hips, from a thigh of its own to a foot, with a joint between them.
/// `knee` is -1 where there is none, `toe` where none hangs from the foot. The foot of a leg that ends without one is
/// the shin, which begins at the knee, and `ankle` the way to its end.
struct Leg {
  int thigh = -1, knee = -1, foot = -1, toe = -1;
  int above_foot = -1;                ///< The foot's parent.
  Vector3 hinge = Vector3::UnitX();   ///< The axis that the knee bends about, as the thigh sees it.
  Vector3 ankle = Vector3::Zero();    ///< m, from the foot's head, as the foot sees it.
  Vector3 across = Vector3::UnitX();  ///< To the character's left at rest, as the foot sees it.

  bool exists() const { return knee >= 0; }
  bool has_foot() const { return foot != knee; }
};

/// The legs of a body, by their numbers; those that exist, none, two or four, are the first ones.
struct Legs {
  std::array<Leg, kMostLegs> all;

  Leg& operator[](std::size_t number) { return all[number]; }
  const Leg& operator[](std::size_t number) const { return all[number]; }
  int count() const { return all[2].exists() ? 4 : all[0].exists() ? 2 : 0; }
  Leg* begin() { return all.data(); }
  Leg* end() { return all.data() + count(); }
  const Leg* begin() const { return all.data(); }
  const Leg* end() const { return all.data() + count(); }
};

/// The left and the right leg, and the fore legs of a four-legged body; none of a pair of which the skeleton has not
/// both. The knee is the joint that divides a leg most evenly; it bends to the front of the rest pose.
Legs resting_legs(const Skeleton& skeleton);

/// World places and rotations of all bones of one pose, which legs are bent in.
struct PosedBones {
  std::vector<Vector3> heads;
  std::vector<Quaternion> rotations;

  explicit PosedBones(int bones) : heads(bones), rotations(bones) {}
};

/// The ball of a foot: the toe's head, or, where there is no toe (-1), the foot's tip.
Vector3 ball(const Skeleton& skeleton, int foot, int toe, const PosedBones& posed);
inline Vector3 ball(const Skeleton& skeleton, const Leg& leg, const PosedBones& posed) {
  return ball(skeleton, leg.foot, leg.toe, posed);
}

/// Where a leg's lower bone ends: the foot's head, or, where a shin is the foot, its tip.
Vector3 ankle_of(const Leg& leg, const PosedBones& posed);

/// Turns the foot where there is one: what reach() leaves it at.
inline void turn_to(const Leg& leg, const Quaternion& world, PosedBones& posed) {
  if (leg.has_foot()) posed.rotations[leg.foot] = world;
}

/// Where a foot treads, standing or not: under the middle of heel and ball, as low as the lower one.
Vector3 sole(const Skeleton& skeleton, const LegRoles& leg, const PosedBones& posed);

/// From the thigh's head over the knee to the foot's, m; and as much of it as the leg reaches.
double leg_length(const Leg& leg, const PosedBones& posed);
double longest(const Leg& leg, const PosedBones& posed);
/// How near its ankle comes to its hip, m: as near as it is, or as where its knee resists being folded up.
double shortest(const Leg& leg, const PosedBones& posed);

/// Two-bone inverse kinematics: bends the knee, to the front where it is nearly straight, and swings the thigh, so that
/// the leg's ankle comes to `ankle` or as near as the leg is long; near its length a leg follows ever less, so that its
/// knee does not snap. Foot and toe keep their world rotations. Writes the local `rotations` [bones, 4] of thigh, knee
/// and foot; `posed` stays as it was before.
void reach(const Skeleton& skeleton, const Leg& leg, const PosedBones& posed, const Vector3& ankle, double* rotations);

/// How far the ends of a leg may be from each other, m.
struct Reach {
  double least = 0, most = 0;
};

/// reach() to the very place, as far as the ends of the leg may be from each other.
void reach(const Skeleton& skeleton, const Leg& leg, const PosedBones& posed, const Vector3& ankle, const Reach& within,
           double* rotations);

using LegPair = std::array<const Leg*, 2>;

/// The same of two legs, to the bit, in less time than of one after the other; the first where `within` is null.
void reach(const Skeleton& skeleton, const LegPair& legs, const PosedBones& posed, const std::array<Vector3, 2>& ankles,
           double* rotations, const Reach* within = nullptr);

/// An arm by its roles: any chain of bones from a shoulder joint of its own to a hand, with a joint between them.
struct Arm {
  int upper = -1, elbow = -1, hand = -1;
  Vector3 hinge = Vector3::UnitX();  ///< The axis that the elbow bends about, as the upper arm sees it.

  bool exists() const { return elbow >= 0; }
};

/// The left and the right arm below the bone that both hang from, each where the skeleton has it. Shoulder and elbow
/// are the joints that divide the way to the hand into the two longest and most even parts. The hinge is not known yet.
std::array<Arm, 2> resting_arms(const Skeleton& skeleton);

/// The middle of the hand.
Vector3 palm(const Skeleton& skeleton, const Arm& arm, const PosedBones& posed);

/// From the shoulder over the elbow to the palm, m.
double arm_length(const Skeleton& skeleton, const Arm& arm, const PosedBones& posed);

/// Two-bone inverse kinematics as that of a leg, but that the hand goes along with the forearm: the palm comes to
/// `place`. Up to kTires of its length it is there; beyond, it follows ever less. The arm swings by way of
/// `halfway`, a direction, so that the elbow is where it is of an arm that is raised so. An elbow that is straight
/// or bent backward stays so by as much as `weight` is below 1.
void reach(const Skeleton& skeleton, const Arm& arm, const PosedBones& posed, const Vector3& place, double weight,
           const Vector3& halfway, double* rotations);

}  // namespace fragmotion

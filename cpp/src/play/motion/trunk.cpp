// SPDX-License-Identifier: MIT
#include "motion/trunk.hpp"

namespace fragmotion {
namespace {

// The bone from which both hang, -1 where it is not below the hips.
int fork(const Skeleton& skeleton, int a, int b) {
  if (a < 0 || b < 0) return -1;
  while (a >= 0 && !skeleton.is_below(b, a)) a = skeleton.parents[a];
  if (a < 0) return -1;
  return a != skeleton.roles.hips && skeleton.is_below(a, skeleton.roles.hips) ? a : -1;
}

}  // namespace

Trunk::Trunk(const Skeleton& skeleton)
    : chest(fork(skeleton, skeleton.roles.left_hand, skeleton.roles.right_hand)), head(skeleton.roles.head) {
  if (chest < 0) return;
  if (head >= 0 && !skeleton.is_below(head, chest)) head = -1;
  const auto carries_a_leg = [&](int bone) {
    const Roles& roles = skeleton.roles;
    return skeleton.is_below(roles.left_foot, bone) || skeleton.is_below(roles.right_foot, bone);
  };
  for (int b = chest; b != skeleton.roles.hips && !carries_a_leg(b); b = skeleton.parents[b]) base = b;
}

Quaternion world_turn(const Skeleton& skeleton, int bone, const double* rotations) {
  Quaternion world = load_quaternion(&rotations[std::size_t{4} * bone]);
  for (int b = bone; b != skeleton.roles.hips;) {
    b = skeleton.parents[b];
    world = product(load_quaternion(&rotations[std::size_t{4} * b]), world);
  }
  return world;
}

void turn_bone(const Skeleton& skeleton, int bone, const Vector3& axis, double angle, double* rotations) {
  const PlaneTurn half(angle / 2);
  const Vector3 turn = half.sine * turned(world_turn(skeleton, bone, rotations).conjugate(), axis);
  double* local = &rotations[std::size_t{4} * bone];
  store_quaternion((load_quaternion(local) * Quaternion{half.cosine, turn.x(), turn.y(), turn.z()}).normalized(),
                   local);
}

int spine_bones(const Skeleton& skeleton, const Trunk& trunk) {
  int bones = 1;
  for (int b = trunk.chest; b != trunk.base; b = skeleton.parents[b]) ++bones;
  return bones;
}

void turn_spine(const Skeleton& skeleton, const Trunk& trunk, const Vector3& axis, double angle, double* rotations) {
  if (trunk.base < 0) return;
  const double each = angle / spine_bones(skeleton, trunk);
  for (int b = trunk.chest; b != skeleton.parents[trunk.base]; b = skeleton.parents[b])
    turn_bone(skeleton, b, axis, each, rotations);
  if (trunk.head >= 0) turn_bone(skeleton, trunk.head, axis, -kHeadBack * angle, rotations);
}

}  // namespace fragmotion

// SPDX-License-Identifier: MIT
#include "retarget/twists.hpp"

#include <cmath>

#include "retarget/posture.hpp"

namespace fragmotion {
namespace {

// The bone that a limb's is turned against, and whether the limb is the lower of the two.
struct Joint {
  int other = -1;
  bool limb_is_above = false;
};

int chest_of(const RoleMap& map) {
  const std::vector<int> spine = map.chain(Role::kSpine);
  return spine.empty() ? map.bone(Role::kHips) : spine.back();
}

Joint joint_of(const RoleMap& map, const RoleBone& limb) {
  const int shoulder = map.bone(Role::kShoulder, limb.side);
  switch (limb.role) {
    case Role::kUpperArm:
      return {shoulder >= 0 ? shoulder : chest_of(map), false};
    case Role::kLowerArm:
      return {map.bone(Role::kHand, limb.side), true};
    case Role::kThigh:
      return {map.bone(Role::kHips), false};
    case Role::kShin:
      return {map.bone(Role::kFoot, limb.side), true};
    default:
      return {};
  }
}

// The bone that a limb points to.
int end_of(const RoleMap& map, const RoleBone& limb) {
  if (limb.role == Role::kUpperArm) return map.bone(Role::kLowerArm, limb.side);
  if (limb.role == Role::kThigh) return map.bone(Role::kShin, limb.side);
  return joint_of(map, limb).other;
}

// The part of a rotation that is about an axis, rad.
double angle_about(const Quaternion& rotation, const Vector3& axis) {
  return wrapped(2 * std::atan2(rotation.vec().dot(axis), rotation.w()));
}

}  // namespace

Twists::Twists(const Body& body) {
  for (const TwistBone& bone : body.map.twists) {
    for (const RoleBone& limb : body.map.bones) {
      if (limb.bone == bone.limb) add(body, bone, limb);
    }
  }
}

void Twists::add(const Body& body, const TwistBone& bone, const RoleBone& limb) {
  const Joint joint = joint_of(body.map, limb);
  const int end = end_of(body.map, limb);
  if (joint.other < 0 || end < 0) return;
  const PosedBones rest = rest_posture(body.skeleton());
  const Quaternion to_limb = rest.rotations[limb.bone].conjugate();
  Twist twist;
  twist.bone = bone.bone;
  twist.limb = limb.bone;
  twist.above = joint.limb_is_above ? limb.bone : joint.other;
  twist.below = joint.limb_is_above ? joint.other : limb.bone;
  twist.share = joint.limb_is_above ? bone.share : bone.share - 1;
  twist.axis = (to_limb * (rest.heads[end] - rest.heads[limb.bone])).normalized();
  twist.rest = to_limb * rest.rotations[bone.bone];
  twist.joint = body.reference[twist.above].conjugate() * body.reference[twist.below];
  twists_.push_back(twist);
}

std::vector<int> Twists::bones() const {
  std::vector<int> bones;
  for (const Twist& twist : twists_) bones.push_back(twist.bone);
  return bones;
}

void Twists::apply(std::vector<Quaternion>& rotations) const {
  for (const Twist& twist : twists_) {
    const Quaternion joint = rotations[twist.above].conjugate() * rotations[twist.below];
    const bool upper = twist.below == twist.limb;  // the turn as the limb sees it
    const Quaternion turn = upper ? twist.joint.conjugate() * joint : joint * twist.joint.conjugate();
    const Quaternion share(Eigen::AngleAxisd(twist.share * angle_about(turn, twist.axis), twist.axis));
    rotations[twist.bone] = rotations[twist.limb] * share * twist.rest;
  }
}

}  // namespace fragmotion

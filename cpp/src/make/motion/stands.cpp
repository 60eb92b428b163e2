// SPDX-License-Identifier: MIT
#include "motion/stands.hpp"

#include "skeleton/two_bone_ik.hpp"

namespace fragmotion {

bool stands(const Kinematics& kinematics, const Clip& clip) {
  const Skeleton& skeleton = kinematics.skeleton();
  std::vector<LegRoles> legs;
  for (const LegRoles& leg : leg_roles(skeleton.roles)) {
    if (leg.foot >= 0) legs.push_back(leg);
  }
  PosedBones posed(kinematics.bones());
  for (int f = 0; f < clip.frames; ++f) {
    world(kinematics, clip, f, posed.heads.data(), posed.rotations.data());
    Vector3 up = posed.heads[skeleton.roles.hips];
    for (const LegRoles& leg : legs) up -= sole(skeleton, leg, posed) / static_cast<double>(legs.size());
    if (up.z() > up.head<2>().norm()) return true;
  }
  return legs.empty();
}

}  // namespace fragmotion

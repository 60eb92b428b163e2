// SPDX-License-Identifier: MIT
#include "motion/stands.hpp"

namespace fragmotion {

bool stands(const Kinematics& kinematics, const Clip& clip) {
  const Roles& roles = kinematics.skeleton().roles;
  std::vector<int> feet;
  for (const LegRoles& leg : leg_roles(roles)) {
    if (leg.foot >= 0) feet.push_back(leg.foot);
  }
  PosedBones posed(kinematics.bones());
  for (int f = 0; f < clip.frames; ++f) {
    world(kinematics, clip, f, posed.heads.data(), posed.rotations.data());
    Vector3 up = posed.heads[roles.hips];
    for (const int foot : feet) up -= posed.heads[foot] / static_cast<double>(feet.size());
    if (up.z() > up.head<2>().norm()) return true;
  }
  return feet.empty();
}

}  // namespace fragmotion

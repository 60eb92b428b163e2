// SPDX-License-Identifier: MIT
#include "skeleton/legs_to_ground.hpp"

#include <vector>

#include "skeleton/role_map.hpp"

namespace fragmotion {

Skeleton with_legs_to_ground(Skeleton skeleton, double ground) {
  const std::vector<LegRoles> legs = legs_with_feet(skeleton.roles);
  if (legs.size() != 2 || has_knee(skeleton, legs[0]) || has_knee(skeleton, legs[1])) return skeleton;
  const RoleMap map = find_role_map(skeleton);
  if (map.bone(Role::kFoot, Side::kLeft) >= 0 || map.bone(Role::kFoot, Side::kRight) >= 0) return skeleton;
  std::vector<Vector3> heads;
  std::vector<Quaternion> rotations;
  rest_pose(skeleton, heads, rotations);
  for (const auto& [thigh, foot, toe] : legs) {
    const double height = heads[foot].z() - ground;
    if (height <= 0) continue;
    Vector3 way = rotations[foot] * skeleton.tips[foot];
    way = leads_down(way) ? Vector3{way * (height / -way.z())} : Vector3{0, 0, -height};
    skeleton.tips[foot] = rotations[foot].conjugate() * way;
  }
  return skeleton;
}

}  // namespace fragmotion

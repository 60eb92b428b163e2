// SPDX-License-Identifier: MIT
#include "skeleton/roles.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "skeleton/role_map.hpp"
#include "skeleton/role_names.hpp"
#include "skeleton/standing_legs.hpp"

namespace fragmotion {
namespace {

/// The first bone that carries three others or more, as hips do, else bone 0.
int first_branching(const Skeleton& skeleton) {
  std::vector<int> children(skeleton.names.size(), 0);
  for (int bone = 1; bone < skeleton.size(); ++bone) ++children[skeleton.parents[bone]];
  const auto branching = std::find_if(children.begin(), children.end(), [](int count) { return count >= 3; });
  return branching == children.end() ? 0 : static_cast<int>(branching - children.begin());
}

/// The foot, or what a leg ends in that has none.
int end_of_leg(const RoleMap& map, Side side) {
  for (const Role role : {Role::kFoot, Role::kShin, Role::kThigh}) {
    if (map.bone(role, side) >= 0) return map.bone(role, side);
  }
  return -1;
}

}  // namespace

Roles roles_of(const RoleMap& map) {
  Roles roles;
  roles.hips = map.bone(Role::kHips);
  roles.head = map.bone(Role::kHead);
  roles.left_hand = map.bone(Role::kHand, Side::kLeft);
  roles.right_hand = map.bone(Role::kHand, Side::kRight);
  roles.left_foot = end_of_leg(map, Side::kLeft);
  roles.right_foot = end_of_leg(map, Side::kRight);
  roles.left_toe = map.bone(Role::kToe, Side::kLeft);
  roles.right_toe = map.bone(Role::kToe, Side::kRight);
  roles.left_thigh = map.bone(Role::kThigh, Side::kLeft);
  roles.right_thigh = map.bone(Role::kThigh, Side::kRight);
  roles.left_fore_foot = map.bone(Role::kForeFoot, Side::kLeft);
  roles.right_fore_foot = map.bone(Role::kForeFoot, Side::kRight);
  roles.left_fore_toe = map.bone(Role::kForeToe, Side::kLeft);
  roles.right_fore_toe = map.bone(Role::kForeToe, Side::kRight);
  roles.left_fore_leg = map.bone(Role::kForeLeg, Side::kLeft);
  roles.right_fore_leg = map.bone(Role::kForeLeg, Side::kRight);
  return roles;
}

Roles find_roles(const Skeleton& skeleton) {
  Roles roles = roles_of(find_role_map(skeleton));
  if (legs_with_feet(roles).empty() && legs_with_feet(skeleton.roles).empty()) tell_standing_legs(skeleton, roles);
  if (roles.hips < 0) roles.hips = first_branching(skeleton);
  return roles;
}

Skeleton make_skeleton(Skeleton given) {
  Skeleton skeleton = checked_skeleton(std::move(given));
  const Roles found = find_roles(skeleton);
  for (const auto& [name, member] : role_names()) {
    if (skeleton.roles.*member == -1) skeleton.roles.*member = found.*member;
  }
  return skeleton;
}

}  // namespace fragmotion

// SPDX-License-Identifier: MIT
#include <algorithm>
#include <utility>

#include "fragmotion/skeleton/role_map.hpp"
#include "fragmotion/skeleton/skeleton.hpp"
#include "skeleton/bone_names.hpp"

namespace fragmotion {
namespace {

/// The first bone that carries three others or more, as hips do, else bone 0.
int first_branching(const Skeleton& skeleton) {
  std::vector<int> children(skeleton.names.size(), 0);
  for (int bone = 1; bone < skeleton.size(); ++bone) ++children[skeleton.parents[bone]];
  const auto branching = std::find_if(children.begin(), children.end(), [](int count) { return count >= 3; });
  return branching == children.end() ? 0 : static_cast<int>(branching - children.begin());
}

}  // namespace

Roles roles_of(const RoleMap& map) {
  Roles roles;
  roles.hips = map.bone(Role::kHips);
  roles.head = map.bone(Role::kHead);
  roles.left_hand = map.bone(Role::kHand, Side::kLeft);
  roles.right_hand = map.bone(Role::kHand, Side::kRight);
  roles.left_foot = map.bone(Role::kFoot, Side::kLeft);
  roles.right_foot = map.bone(Role::kFoot, Side::kRight);
  roles.left_toe = map.bone(Role::kToe, Side::kLeft);
  roles.right_toe = map.bone(Role::kToe, Side::kRight);
  roles.left_thigh = map.bone(Role::kThigh, Side::kLeft);
  roles.right_thigh = map.bone(Role::kThigh, Side::kRight);
  return roles;
}

Roles find_roles(const Skeleton& skeleton) {
  Roles roles = roles_of(find_role_map(skeleton));
  if (roles.hips < 0) roles.hips = first_branching(skeleton);
  return roles;
}

std::vector<int> mirror_bones(const Skeleton& skeleton) {
  const std::vector<BoneName> names = read_names(skeleton.names);
  std::vector<int> mirror(names.size());
  for (int bone = 0; bone < skeleton.size(); ++bone) {
    const int other = names[bone].counterpart;
    // Both must name each other: names that differ only in case would pair three bones.
    mirror[bone] = other >= 0 && names[other].counterpart == bone ? other : bone;
  }
  return mirror;
}

std::vector<int> measured_bones(const Skeleton& skeleton) {
  const Roles& roles = skeleton.roles;
  const std::vector<BoneName> names = read_names(skeleton.names);
  const auto is_beyond = [&](int bone, int end) { return end >= 0 && bone != end && skeleton.is_below(bone, end); };
  const int hips = std::max(roles.hips, 0);
  std::vector<int> bones{hips};  // whatever the roles are, Dis sums over something
  for (int bone = hips + 1; bone < skeleton.size(); ++bone) {
    if (!skeleton.is_below(bone, hips)) continue;
    const bool is_face = is_beyond(bone, roles.head);
    const bool is_hand_part = is_beyond(bone, roles.left_hand) || is_beyond(bone, roles.right_hand);
    // CMU's thumbs hang on the wrist beside the hand, so the place alone does not tell fingers.
    const bool is_named_finger = names[bone].side != Side::kNone && is_finger(names[bone]);
    if (!is_face && !is_hand_part && !is_named_finger) bones.push_back(bone);
  }
  return bones;
}

}  // namespace fragmotion

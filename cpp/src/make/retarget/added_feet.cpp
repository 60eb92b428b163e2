// SPDX-License-Identifier: MIT
#include "retarget/added_feet.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include "skeleton/body_words.hpp"

namespace fragmotion {
namespace {

bool is_called_a_foot(const BoneName& name) {
  return name.side != Side::kNone && says(name)[static_cast<int>(Role::kFoot)] > 0;
}

bool has_feet(const Skeleton& skeleton, const RoleMap& map) {
  const std::vector<BoneName> names = read_names(skeleton.names);
  return map.bone(Role::kFoot, Side::kLeft) >= 0 || map.bone(Role::kFoot, Side::kRight) >= 0 ||
         std::any_of(names.begin(), names.end(), is_called_a_foot);
}

// Whether a leg's shin is its last bone, and ends below all others begin.
bool ends_with_shin(const Skeleton& skeleton, const RoleMap& map, Side side) {
  const int thigh = map.bone(Role::kThigh, side), shin = map.bone(Role::kShin, side);
  if (thigh < 0 || shin < 0 || std::count(skeleton.parents.begin(), skeleton.parents.end(), shin) > 0) return false;
  std::vector<Vector3> heads;
  std::vector<Quaternion> rotations;
  rest_pose(skeleton, heads, rotations);
  const double end = (heads[shin] + rotations[shin] * skeleton.tips[shin]).z(), hip = heads[thigh].z();
  return std::none_of(heads.begin(), heads.end(),
                      [&](const Vector3& head) { return head.z() < hip && head.z() < end && !head.isZero(0); });
}

void add_foot(Side side, Footed& body) {
  Skeleton& skeleton = body.skeleton;
  const int shin = body.map.bone(Role::kShin, side), foot = skeleton.size();
  std::string name = role_label(Role::kFoot, side);
  while (skeleton.find(name) >= 0) name += '_';
  skeleton.names.push_back(name);
  skeleton.parents.push_back(shin);
  skeleton.rest_rotations.push_back(Quaternion::Identity());
  skeleton.offsets.push_back(skeleton.tips[shin]);
  skeleton.tips.emplace_back(-skeleton.tips[shin]);  // up: as of all feet that point there, it is told ahead
  body.map.bones.push_back({Role::kFoot, side, -1, 0, foot, body.map.confidence(Role::kShin, side)});
}

bool leads_along(const Vector3& way, const Vector3& direction) {
  const Vector3 along = direction * way.dot(direction);
  return way.dot(direction) > (way - along).norm();
}

bool is_stub(const Skeleton& skeleton, const RoleMap& map, Side side) {
  const int shin = map.bone(Role::kShin, side), foot = map.bone(Role::kFoot, side), toe = map.bone(Role::kToe, side);
  if (shin < 0 || foot < 0 || toe < 0 || !skeleton.is_below(foot, shin) || !skeleton.is_below(toe, foot)) return false;
  std::vector<Vector3> heads;
  std::vector<Quaternion> rotations;
  rest_pose(skeleton, heads, rotations);
  const Vector3 down = (heads[foot] - heads[shin]).normalized(), stub = heads[toe] - heads[foot],
                ahead = rotations[toe] * skeleton.tips[toe];
  return stub.norm() < ahead.norm() && leads_along(stub, down) && !leads_along(ahead, down);
}

void let_toe_be_foot(Side side, RoleMap& map) {
  for (auto bone = map.bones.begin(); bone != map.bones.end();) {
    const bool is_foot = bone->side == side && bone->role == Role::kFoot;
    if (bone->side == side && bone->role == Role::kToe && bone->order-- == 0)
      *bone = {Role::kFoot, side, -1, 0, bone->bone, bone->confidence};
    bone = is_foot ? map.bones.erase(bone) : bone + 1;
  }
}

}  // namespace

RoleMap with_feet_ahead(const Skeleton& skeleton, RoleMap map) {
  const bool left = is_stub(skeleton, map, Side::kLeft), right = is_stub(skeleton, map, Side::kRight);
  if (left && right) {
    for (const Side side : {Side::kLeft, Side::kRight}) let_toe_be_foot(side, map);
  }
  return map;
}

Footed with_feet(const Skeleton& skeleton, const RoleMap& map) {
  Footed body{skeleton, map};
  const bool stands_on_shins = !has_feet(skeleton, map) && ends_with_shin(skeleton, map, Side::kLeft) &&
                               ends_with_shin(skeleton, map, Side::kRight);
  if (!stands_on_shins) return body;
  for (const Side side : {Side::kLeft, Side::kRight}) add_foot(side, body);
  return body;
}

}  // namespace fragmotion

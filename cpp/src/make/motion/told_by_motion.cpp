// SPDX-License-Identifier: MIT
#include "motion/told_by_motion.hpp"

#include <algorithm>
#include <utility>

#include "base/turn_between.hpp"
#include "skeleton/role_map.hpp"
#include "skeleton/roles.hpp"
#include "skeleton/same_skeleton.hpp"

namespace fragmotion {
namespace {

void add_pose(const Take& take, int frame, ObservedPoses& poses) {
  const std::size_t bones = take.skeleton.size(), first = frame * bones;
  std::vector<double> heads(3 * bones), rotations(4 * bones);
  world_transforms(take.skeleton, &take.translations[3 * first], &take.rotations[4 * first], heads.data(),
                   rotations.data());
  std::vector<Vector3> places;
  for (std::size_t b = 0; b < bones; ++b) places.push_back(load_vector(&heads[3 * b]));
  if (!std::all_of(places.begin(), places.end(), [](const Vector3& place) { return place.allFinite(); })) return;
  poses.heads.insert(poses.heads.end(), places.begin(), places.end());
  ++poses.poses;
}

// As many of each second of all takes.
ObservedPoses observed(const std::vector<Take*>& takes) {
  int frames = 0;
  for (const Take* take : takes) frames += take->frames;
  ObservedPoses poses;
  for (const Take* take : takes) {
    for (int f = 0; f < take->frames; f += frames_between_looks(frames)) add_pose(*take, f, poses);
  }
  return poses;
}

ObservedPoses turned(ObservedPoses poses, const Quaternion& turn) {
  for (Vector3& head : poses.heads) head = turn * head;
  return poses;
}

// Whichever axis is up in the file.
void tell(const std::vector<Take*>& takes) {
  if (takes.front()->skeleton.roles.left_fore_foot >= 0) return;
  const ObservedPoses poses = observed(takes);
  if (poses.poses == 0) return;
  for (const Vector3& up : {Vector3{0, 0, 1}, Vector3{0, 1, 0}, Vector3{0, -1, 0}, Vector3{1, 0, 0}, Vector3{-1, 0, 0},
                            Vector3{0, 0, -1}}) {
    const ObservedPoses upright = turned(poses, turn_between(up, Vector3::UnitZ()));
    const RoleMap map = find_role_map(takes.front()->skeleton, &upright);
    if (map.bone(Role::kForeFoot, Side::kLeft) < 0) continue;
    for (Take* take : takes) take->skeleton.roles = roles_of(map);
    return;
  }
}

}  // namespace

void tell_four_legs(const std::vector<Take*>& takes) {
  std::vector<Skeleton> skeletons;
  for (const Take* take : takes) skeletons.push_back(take->skeleton);
  for (const std::vector<int>& group : group_skeletons(skeletons)) {
    std::vector<Take*> same;
    for (const int member : group) same.push_back(takes[member]);
    tell(same);
  }
}

}  // namespace fragmotion

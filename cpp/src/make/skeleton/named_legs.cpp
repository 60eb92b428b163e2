// SPDX-License-Identifier: MIT
#include "skeleton/named_legs.hpp"

#include <algorithm>

namespace fragmotion {
namespace {

constexpr double kJointApart = 0.15, kJointBent = 0.4;  // of the bones' lengths; sine
constexpr double kBeside = 0.25;  // of a shin's length: the real ankle is no further from a foot that is none
constexpr double kGoesOn = 0.1;   // of a shin's length, that a foot has at least

std::vector<Vector3> rest_heads(const Skeleton& skeleton) {
  std::vector<Vector3> heads;
  std::vector<Quaternion> rotations;
  rest_pose(skeleton, heads, rotations);
  return heads;
}

/// Whether a bone that is skipped between two of a limb bends away from their line at rest.
bool has_joint_between(const std::vector<Vector3>& heads, const BodyTree& tree, int upper, int lower) {
  if (!tree.is_below(lower, upper)) return false;
  for (int b = tree.parents[lower]; b != upper; b = tree.parents[b]) {
    const Vector3 before = heads[b] - heads[upper], after = heads[lower] - heads[b];
    const bool is_long = std::min(before.norm(), after.norm()) > kJointApart * (heads[lower] - heads[upper]).norm();
    if (is_long && before.cross(after).norm() > kJointBent * before.norm() * after.norm()) return true;
  }
  return false;
}

/// The first bone of the body that hangs on another, at least so far from it; -1 where there is none.
int next_bone(const std::vector<Vector3>& heads, const BodyTree& tree, int bone, double least) {
  for (int b = bone + 1; b < tree.size(); ++b) {
    if (tree.parents[b] == bone && tree.in_body[b] && !tree.twist[b] && (heads[b] - heads[bone]).norm() >= least)
      return b;
  }
  return -1;
}

/// The leg's chain is the one that carries what is seen, and goes on to the ground.
void leave_dead_end(const std::vector<Vector3>& heads, const BodyTree& tree, Limb& leg) {
  const int shin = leg.bones[Limb::kLower], foot = leg.bones[Limb::kEnd];
  if (shin < 0 || foot < 0) return;
  const bool bare = tree.bare[foot], goes_on = leg.bones[Limb::kTip] >= 0 || next_bone(heads, tree, foot, 0) >= 0;
  if (goes_on && !bare) return;
  const double length = (heads[foot] - heads[shin]).norm();
  for (int b = shin + 1; b < tree.size(); ++b) {
    const bool beside = b != foot && tree.in_body[b] && !tree.twist[b] && tree.parents[b] == tree.parents[foot] &&
                        tree.says(b, Role::kFoot) >= 0 && (heads[b] - heads[foot]).norm() <= kBeside * length;
    if (!beside || tree.bare[b]) continue;
    const int toe = next_bone(heads, tree, b, kGoesOn * length);
    if (toe < 0 && !bare) continue;
    leg.bones[Limb::kEnd] = b, leg.bones[Limb::kTip] = toe;
    leg.confidence[Limb::kEnd] = leg.confidence[Limb::kTip] = kByPlace;
    return;
  }
}

}  // namespace

void mend_named_legs(const Skeleton& skeleton, const BodyTree& tree, BodyJoints& body) {
  const std::vector<Vector3> heads = rest_heads(skeleton);
  for (Limb& leg : body.legs) leave_dead_end(heads, tree, leg);
  forget_shins_of_beasts(skeleton, tree, body);
}

void forget_shins_of_beasts(const Skeleton& skeleton, const BodyTree& tree, BodyJoints& body) {
  const std::vector<Vector3> heads = rest_heads(skeleton);
  for (Limb& leg : body.legs) {
    int& shin = leg.bones[Limb::kLower];
    if (shin < 0) continue;
    const int thigh = leg.bones[Limb::kUpper], foot = leg.bones[Limb::kEnd];
    const bool more = (thigh >= 0 && has_joint_between(heads, tree, thigh, shin)) ||
                      (foot >= 0 && has_joint_between(heads, tree, shin, foot));
    if (more) shin = -1;
  }
}

}  // namespace fragmotion

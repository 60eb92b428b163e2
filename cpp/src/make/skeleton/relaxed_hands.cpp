// SPDX-License-Identifier: MIT
#include "skeleton/relaxed_hands.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/turn_between.hpp"
#include "skeleton/bone_names.hpp"
#include "skeleton/likely_tips.hpp"
#include "skeleton/role_map.hpp"

namespace fragmotion {
namespace {

constexpr double kAtRest[] = {45 * kPi / 180, 37.5 * kPi / 180,
                              15 * kPi / 180};  // rad, from the knuckle to the last joint
constexpr int kThumbDigit = 0, kDigits = 5, kFewestFingers = 2;

using FingerChains = std::array<std::vector<int>, kDigits>;

// From the knuckle on, of the hand of a side; none of thumbs.
FingerChains fingers_of(const std::vector<BoneName>& names, const RoleMap& map, Side side) {
  FingerChains chains;
  std::vector<RoleBone> bones = map.bones;
  std::stable_sort(bones.begin(), bones.end(), [](const RoleBone& a, const RoleBone& b) { return a.order < b.order; });
  for (const RoleBone& bone : bones) {
    if (bone.role != Role::kFinger || bone.side != side || bone.finger <= kThumbDigit) continue;
    if (!has_any_word(names[bone.bone], {"metacarpal", "carpal", "palm", "meta"}))
      chains[bone.finger].push_back(bone.bone);
  }
  const auto has = [](const std::vector<int>& chain) { return !chain.empty(); };
  if (std::count_if(chains.begin(), chains.end(), has) < kFewestFingers) return {};
  return chains;
}

// A hand at rest: where its fingers point that are straight and side by side, and what they bend about.
struct Palm {
  Vector3 ahead, hinge;
};

Palm palm_of(const FingerChains& fingers, int hand, Side side, const std::vector<Vector3>& heads) {
  std::vector<Vector3> knuckles;
  for (const std::vector<int>& finger : fingers) {
    if (!finger.empty()) knuckles.push_back(heads[finger.front()]);
  }
  const Vector3 across = (knuckles.back() - knuckles.front()).normalized();
  Vector3 ahead = Vector3::Zero();
  for (const Vector3& knuckle : knuckles) ahead += knuckle - heads[hand];
  ahead = (ahead - ahead.dot(across) * across).normalized();
  return {ahead, side == Side::kRight ? Vector3{-across} : across};
}

// Bends the fingers of a hand in a pose's local rotations.
void relax(const Skeleton& skeleton, const FingerChains& fingers, const Palm& palm, const std::vector<Vector3>& heads,
           const std::vector<Quaternion>& rest, double* rotations) {
  for (const std::vector<int>& finger : fingers) {
    double bent = 0;
    Quaternion parent_turn = Quaternion::Identity();
    for (std::size_t joint = 0; joint < finger.size(); ++joint) {
      const int bone = finger[joint];
      bent += joint < std::size(kAtRest) ? kAtRest[joint] : 0;
      const bool last = joint + 1 == finger.size();
      const Vector3 now =
          last ? Vector3{rest[bone] * skeleton.tips[bone]} : Vector3{heads[finger[joint + 1]] - heads[bone]};
      const Quaternion turn = turn_between(now, Eigen::AngleAxisd(bent, palm.hinge) * palm.ahead);
      const Quaternion above = parent_turn * rest[skeleton.parents[bone]];
      store_quaternion((above.conjugate() * turn * rest[bone]).normalized(), rotations + std::ptrdiff_t{4} * bone);
      parent_turn = turn;
    }
  }
}

template <typename Visit>
void for_each_hand(const Skeleton& skeleton, const RoleMap& map, const Visit& visit) {
  const std::vector<BoneName> names = read_names(skeleton.names);
  for (const Side side : {Side::kLeft, Side::kRight}) {
    const int hand = map.bone(Role::kHand, side);
    const FingerChains fingers = fingers_of(names, map, side);
    if (hand >= 0) visit(fingers, hand, side);
  }
}

}  // namespace

std::vector<int> finger_bones(const Skeleton& skeleton) {
  std::vector<int> bones;
  for_each_hand(skeleton, find_role_map(skeleton), [&](const FingerChains& fingers, int, Side) {
    for (const std::vector<int>& finger : fingers) bones.insert(bones.end(), finger.begin(), finger.end());
  });
  std::sort(bones.begin(), bones.end());
  return bones;
}

std::vector<double> relaxed_pose(const Skeleton& skeleton) {
  std::vector<double> rotations(std::size_t{4} * skeleton.size());
  for (int b = 0; b < skeleton.size(); ++b)
    store_quaternion(skeleton.rest_rotations[b], &rotations[std::size_t{4} * b]);
  std::vector<Vector3> heads;
  std::vector<Quaternion> rest;
  rest_pose(skeleton, heads, rest);
  const RoleMap map = find_role_map(skeleton);
  const Skeleton likely = with_likely_tips(skeleton, map);
  for_each_hand(skeleton, map, [&](const FingerChains& fingers, int hand, Side side) {
    if (std::all_of(fingers.begin(), fingers.end(), [](const auto& finger) { return finger.empty(); })) return;
    relax(likely, fingers, palm_of(fingers, hand, side, heads), heads, rest, rotations.data());
  });
  return rotations;
}

}  // namespace fragmotion

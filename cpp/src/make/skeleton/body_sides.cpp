// SPDX-License-Identifier: MIT
#include "skeleton/body_sides.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "skeleton/role_map.hpp"
#include "skeleton/two_bone_ik.hpp"

namespace fragmotion {
namespace {

Vector3 level(Vector3 v) {
  v.z() = 0;
  return v;
}

Vector3 down(const Limb& leg, const Vector3* heads) {
  return heads[leg.bones[Limb::kEnd]] - heads[leg.bones[Limb::kUpper]];
}

bool stands(const BodyJoints& body, const Vector3* heads) {
  return std::all_of(body.legs.begin(), body.legs.end(), [&](const Limb& leg) {
    const Vector3 way = down(leg, heads);
    return -way.z() > kSameWay * way.norm();
  });
}

/// Where the feet point, level; zero where they do not.
Vector3 feet_forward(const BodyJoints&, const PosedFeet& pose) {
  const Vector3 forward = level(pose.feet[0] + pose.feet[1]);
  return forward.norm() < kNoDirection * (pose.feet[0].norm() + pose.feet[1].norm()) ? Vector3::Zero() : forward;
}

/// To where the knees are bent, level; zero where they are straight.
Vector3 knees_forward(const BodyJoints& body, const PosedFeet& pose) {
  Vector3 forward = Vector3::Zero();
  for (const Limb& leg : body.legs) {
    const Vector3 knee = pose.heads[leg.bones[Limb::kLower]] - pose.heads[leg.bones[Limb::kUpper]];
    const Vector3 leg_way = down(leg, pose.heads);
    const Vector3 bent = knee - leg_way * (knee.dot(leg_way) / leg_way.squaredNorm());
    if (bent.norm() > kBends * leg_way.norm()) forward += bent;
  }
  return level(forward);
}

/// How far limbs lie to the left as one sign tells it: mean cosines.
struct Sided {
  double legs = 0, arms = 0;
};

template <typename Forward>
Sided sided(const std::vector<PosedFeet>& poses, const BodyJoints& body, Forward&& forward) {
  Sided sided;
  int telling = 0;  // poses; a runner's feet hardly point forward in most
  const bool has_arms = body.arms[0].whole() && body.arms[1].whole();
  for (const PosedFeet& pose : poses) {
    const Vector3 left = stands(body, pose.heads) ? Vector3::UnitZ().cross(forward(body, pose)) : Vector3::Zero();
    if (left.isZero()) continue;
    ++telling;
    sided.legs += across(body.legs, pose.heads).normalized().dot(left.normalized());
    if (has_arms) sided.arms += across(body.arms, pose.heads).normalized().dot(left.normalized());
  }
  if (telling == 0) return {};
  return {sided.legs / telling, sided.arms / telling};
}

}  // namespace

Vector3 across(const std::array<Limb, 2>& limbs, const Vector3* heads) {
  return heads[limbs[0].bones[Limb::kUpper]] - heads[limbs[1].bones[Limb::kUpper]];
}

bool put_left_first(const std::vector<PosedFeet>& poses, BodyJoints& body) {
  const Sided feet = sided(poses, body, feet_forward), knees = sided(poses, body, knees_forward);
  if (feet.legs * knees.legs < 0) return false;
  const Sided& told = std::abs(feet.legs) > std::abs(knees.legs) ? feet : knees;
  if (std::abs(told.legs) < kSameWay) return false;
  if (told.legs < 0) std::swap(body.legs[0], body.legs[1]);
  if (told.arms < 0) std::swap(body.arms[0], body.arms[1]);
  if (std::abs(told.arms) < kSameWay) body.arms = {};
  return true;
}

}  // namespace fragmotion

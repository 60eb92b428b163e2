// SPDX-License-Identifier: MIT
#include "motion/legs.hpp"

#include "base/rounding.hpp"

namespace fragmotion {
namespace {

constexpr int kApart = 5;  // frames of the clips that are looked at: each fifth

// What bends the leg's knee in a pose, as the thigh sees it; the longer the more it is bent.
Vector3 bend(const Leg& leg, const PosedBones& posed) {
  const Vector3 upper = posed.heads[leg.knee] - posed.heads[leg.thigh],
                lower = ankle_of(leg, posed) - posed.heads[leg.knee];
  return posed.rotations[leg.thigh].conjugate() * upper.cross(lower) / (upper.norm() * lower.norm());
}

}  // namespace

void add_bends(const Kinematics& kinematics, const Clip& clip, int apart, Legs& legs) {
  const std::vector<int> bones = kinematics.chains({legs[0].foot, legs[1].foot, legs[2].foot, legs[3].foot});
  PosedBones posed(kinematics.bones());
  for (int f = 0; f < clip.frames; f += apart) {
    world(kinematics, clip, f, bones, posed.heads.data(), posed.rotations.data());
    for (Leg& leg : legs) leg.hinge += bend(leg, posed);
  }
}

Legs find_legs(const Kinematics& kinematics, const std::vector<Clip>& clips) {
  Legs legs = resting_legs(kinematics.skeleton());
  if (!legs[0].exists()) return legs;
  for (const Clip& clip : clips) add_bends(kinematics, clip, kApart, legs);
  for (Leg& leg : legs) leg.hinge = leg.hinge.norm() > kRounding ? leg.hinge.normalized() : Vector3::UnitX();
  return legs;
}

}  // namespace fragmotion

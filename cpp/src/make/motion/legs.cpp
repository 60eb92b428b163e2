// SPDX-License-Identifier: MIT
#include "motion/legs.hpp"

#include "base/rounding.hpp"

namespace fragmotion {
namespace {

constexpr int kApart = 5;  // frames of the clips that are looked at: each fifth

}  // namespace

Vector3 bend_axis(const Leg& leg, const PosedBones& posed) {
  const Vector3 upper = posed.heads[leg.knee] - posed.heads[leg.thigh],
                lower = ankle_of(leg, posed) - posed.heads[leg.knee];
  return posed.rotations[leg.thigh].conjugate() * upper.cross(lower) / (upper.norm() * lower.norm());
}

Legs find_legs(const Kinematics& kinematics, const std::vector<Clip>& clips) {
  Legs legs = resting_legs(kinematics.skeleton());
  if (!legs[0].exists()) return legs;
  const std::vector<int> bones = kinematics.chains({legs[0].foot, legs[1].foot, legs[2].foot, legs[3].foot});
  PosedBones posed(kinematics.bones());
  for (const Clip& clip : clips) {
    for (int f = 0; f < clip.frames; f += kApart) {
      world(kinematics, clip, f, bones, posed.heads.data(), posed.rotations.data());
      for (Leg& leg : legs) leg.hinge += bend_axis(leg, posed);
    }
  }
  for (Leg& leg : legs) leg.hinge = leg.hinge.norm() > kRounding ? leg.hinge.normalized() : Vector3::UnitX();
  return legs;
}

}  // namespace fragmotion

// SPDX-License-Identifier: MIT
#include "fragmotion/runtime/breathing.hpp"

#include <cmath>

#include "base/filtered.hpp"

namespace fragmotion {
namespace {

constexpr double kBreath = 3.6;             // s
constexpr double kAngle = 1.2 * kPi / 180;  // that the chest goes back
constexpr double kLevel = 0.8;              // of it that the head goes forth
constexpr double kDeepens = 0.4;            // s: time constant
constexpr double kUnseen = 1e-3;            // of the depth

}  // namespace

Breathing::Breathing(const Trunk& trunk) : trunk_(trunk) {}

void Breathing::reset() { time_ = depth_ = 0; }

void Breathing::apply(const Skeleton& skeleton, WorldPose& pose, bool stands, double seconds) {
  if (trunk_.chest < 0) return;
  depth_ += ((stands ? 1 : 0) - depth_) * filtered(seconds, kDeepens);
  if (depth_ < kUnseen) return reset();
  time_ = std::fmod(time_ + seconds, kBreath);
  const double angle = -depth_ * kAngle * 0.5 * (1 - std::cos(2 * kPi * time_ / kBreath));
  const Vector3 left{-std::cos(pose.heading), -std::sin(pose.heading), 0};
  turn_bone(skeleton, trunk_.chest, left, angle, pose.rotations.data());
  if (trunk_.head >= 0) turn_bone(skeleton, trunk_.head, left, -kLevel * angle, pose.rotations.data());
}

}  // namespace fragmotion

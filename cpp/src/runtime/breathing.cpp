// SPDX-License-Identifier: MIT
#include "fragmotion/runtime/breathing.hpp"

#include <cmath>

#include "fragmotion/motion/pose.hpp"

namespace fragmotion {
namespace {

constexpr double kBreath = 3.6;             // s
constexpr double kAngle = 1.2 * kPi / 180;  // that the chest goes back
constexpr double kLevel = 0.8;              // of it that the head goes forth
constexpr double kFades = 0.4;              // s: time constant
constexpr double kUnseen = 1e-3;            // of the depth

// The bone from which both hang, -1 where it is not below the hips.
int fork(const Skeleton& skeleton, int a, int b) {
  if (a < 0 || b < 0) return -1;
  while (a >= 0 && !skeleton.is_below(b, a)) a = skeleton.parents[a];
  if (a < 0) return -1;
  return a != skeleton.roles.hips && skeleton.is_below(a, skeleton.roles.hips) ? a : -1;
}

// Turns a bone about the character's left; its children go along.
void pitch(const Skeleton& skeleton, WorldPose& pose, int bone, double angle) {
  double* local = &pose.rotations[std::size_t{4} * bone];
  Quaternion world = load_quaternion(local);
  for (int b = bone; b != skeleton.roles.hips;) {
    b = skeleton.parents[b];
    world = load_quaternion(&pose.rotations[std::size_t{4} * b]) * world;
  }
  const Vector3 left{-std::cos(pose.heading), -std::sin(pose.heading), 0};
  const Quaternion turn{Eigen::AngleAxisd(angle, world.conjugate() * left)};
  store_quaternion((load_quaternion(local) * turn).normalized(), local);
}

}  // namespace

Breathing::Breathing(const Skeleton& skeleton)
    : chest_(fork(skeleton, skeleton.roles.left_hand, skeleton.roles.right_hand)), head_(skeleton.roles.head) {
  if (chest_ >= 0 && head_ >= 0 && !skeleton.is_below(head_, chest_)) head_ = -1;
}

void Breathing::reset() { time_ = depth_ = 0; }

void Breathing::apply(const Skeleton& skeleton, WorldPose& pose, bool stands, double seconds) {
  if (chest_ < 0) return;
  depth_ += ((stands ? 1 : 0) - depth_) * (1 - std::exp(-seconds / kFades));
  if (depth_ < kUnseen) return reset();
  time_ = std::fmod(time_ + seconds, kBreath);
  const double angle = -depth_ * kAngle * 0.5 * (1 - std::cos(2 * kPi * time_ / kBreath));
  pitch(skeleton, pose, chest_, angle);
  if (head_ >= 0) pitch(skeleton, pose, head_, -kLevel * angle);
}

}  // namespace fragmotion

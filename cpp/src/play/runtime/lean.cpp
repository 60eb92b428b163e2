// SPDX-License-Identifier: MIT
#include "runtime/lean.hpp"

#include <cmath>

#include "base/filtered.hpp"

namespace fragmotion {
namespace {

constexpr double kShare = 0.5;     // of the angle that would balance the body
constexpr double kFollows = 0.12;  // s: time constant of each of two filters, so that no lean begins with a jerk
constexpr double kMost = 6,
                 kLeast = 0.1;  // m/s^2 of a 1.8 m character that it follows, and below which nothing is seen

}  // namespace

void Lean::apply(const Skeleton& skeleton, WorldPose& pose, const Vector2& acceleration, double seconds) {
  const Vector2 wanted = clamp_length(scale_ * acceleration, kMost);
  const double part = filtered(seconds, kFollows);
  pushed_ += part * (wanted - pushed_);
  acceleration_ += part * (pushed_ - acceleration_);
  const double strength = acceleration_.norm();
  if (strength < kLeast || trunk_.base < 0) return;
  const Vector2 lean = kShare * std::atan(strength / kGravity) / strength * acceleration_;
  lean_by(skeleton, lean, pose.heading, pose.rotations.data());
}

// Forward from the hips on, and aside by the spine; the legs stay as they are. What is above is turned first, so that
// its sines and cosines are those of the others: hips that have not leaned yet see the axis of the spine turned back.
void Lean::lean_by(const Skeleton& skeleton, const Vector2& lean, double heading, double* rotations) const {
  const Vector3 left{-std::cos(heading), -std::sin(heading), 0};
  const HalfAngle hips(lean.y()), spine(lean.x() / spine_bones(skeleton, trunk_));
  const double upright = hips.cosine * hips.cosine - hips.sine * hips.sine;
  const Vector3 forward{upright * left.y(), -upright * left.x(), 2 * hips.sine * hips.cosine};
  if (trunk_.head >= 0) {
    turn_bone(skeleton, trunk_.head, left, HalfAngle(-kHeadBack * lean.y()), rotations);
    turn_bone(skeleton, trunk_.head, forward, HalfAngle(-kHeadBack * lean.x()), rotations);
  }
  for (int b = trunk_.chest; b != skeleton.parents[trunk_.base]; b = skeleton.parents[b])
    turn_bone(skeleton, b, forward, spine, rotations);
  for (const int thigh : thighs_) {
    if (thigh >= 0) turn_bone(skeleton, thigh, -left, hips, rotations);
  }
  turn_bone(skeleton, skeleton.roles.hips, left, hips, rotations);
}

}  // namespace fragmotion

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
  pitch(skeleton, pose.heading, lean.y(), pose.rotations.data());
  const Vector2 forward = Eigen::Rotation2Dd(pose.heading) * Vector2::UnitY();
  turn_spine(skeleton, trunk_, {forward.x(), forward.y(), 0}, lean.x(), pose.rotations.data());
}

// Forward; the legs stay as they are.
void Lean::pitch(const Skeleton& skeleton, double heading, double angle, double* rotations) const {
  const Vector2 left = Eigen::Rotation2Dd(heading) * -Vector2::UnitX();
  const Vector3 axis{left.x(), left.y(), 0};
  for (const int thigh : thighs_) {
    if (thigh >= 0) turn_bone(skeleton, thigh, axis, -angle, rotations);
  }
  turn_bone(skeleton, skeleton.roles.hips, axis, angle, rotations);
  turn_head_back(skeleton, trunk_, axis, angle, rotations);
}

}  // namespace fragmotion

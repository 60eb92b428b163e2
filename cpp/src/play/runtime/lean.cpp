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
  const double angle = kShare * std::atan(strength / kGravity);
  const Vector2 across = Eigen::Rotation2Dd(pose.heading) * Vector2{-acceleration_.y(), acceleration_.x()} / strength;
  turn_spine(skeleton, trunk_, {across.x(), across.y(), 0}, angle, pose.rotations.data());
}

}  // namespace fragmotion

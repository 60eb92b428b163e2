// SPDX-License-Identifier: MIT
#include "runtime/lean.hpp"

#include <cmath>

#include "base/filtered.hpp"
#include "base/rounding.hpp"

namespace fragmotion {

void Lean::apply(const Skeleton& skeleton, WorldPose& pose, const Vector2& acceleration, double seconds) {
  const Vector2 wanted = clamp_length(scale_ * acceleration, kHard);
  const double part = filtered(seconds, constants_.follows);
  pushed_ += part * (wanted - pushed_);
  acceleration_ += part * (pushed_ - acceleration_);
  const double strength = acceleration_.norm();
  if (strength < kRounding || trunk_.base < 0) return;
  const Vector2 lean = constants_.share * std::atan(strength / kGravity) / strength * acceleration_;
  lean_by(skeleton, lean, pose.heading, pose.rotations.data());
}

// Forward from the hips on, and aside by the spine; the legs stay as they are. What is above is turned first, so that
// its sines and cosines are those of the others: hips that have not leaned yet see the axis of the spine turned back.
void Lean::lean_by(const Skeleton& skeleton, const Vector2& lean, double heading, double* rotations) const {
  const PlaneTurn ahead(heading);
  const Vector3 left{-ahead.cosine, -ahead.sine, 0};
  const HalfAngle hips(lean.y()), spine(lean.x() / spine_bones(skeleton, trunk_));
  const double upright = hips.cosine * hips.cosine - hips.sine * hips.sine;
  const Vector3 forward{upright * left.y(), -upright * left.x(), 2 * hips.sine * hips.cosine};
  if (trunk_.head >= 0) {
    double* head = &rotations[std::size_t{4} * trunk_.head];
    const Quaternion neck = bend(skeleton, skeleton.parents[trunk_.head], false, forward, spine, rotations);
    turn_bone(neck * load_quaternion(head), left, HalfAngle(-kHeadBack * lean.y()), head);
    turn_bone(neck * load_quaternion(head), forward, HalfAngle(-kHeadBack * lean.x()), head);
  } else {
    bend(skeleton, trunk_.chest, true, forward, spine, rotations);
  }
  for (const int thigh : thighs_) {
    if (thigh >= 0) turn_bone(skeleton, thigh, -left, hips, rotations);
  }
  turn_bone(skeleton, skeleton.roles.hips, left, hips, rotations);
}

// Bends the spine from its base up to a bone, or, where that is not of it yet, to the chest below. Returns how the bone
// was turned in the world.
Quaternion Lean::bend(const Skeleton& skeleton, int bone, bool in_spine, const Vector3& axis, const HalfAngle& half,
                      double* rotations) const {
  double* local = &rotations[std::size_t{4} * bone];
  const Quaternion own = load_quaternion(local);
  if (bone == skeleton.roles.hips) return own;
  in_spine = in_spine || bone == trunk_.chest;
  const bool goes_on = in_spine && bone != trunk_.base;
  const Quaternion world = bend(skeleton, skeleton.parents[bone], goes_on, axis, half, rotations) * own;
  if (in_spine) turn_bone(world, axis, half, local);
  return world;
}

}  // namespace fragmotion

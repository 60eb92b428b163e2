// SPDX-License-Identifier: MIT
#include "runtime/lean.hpp"

#include <cmath>

#include "base/rounding.hpp"

namespace fragmotion {
namespace {

Quaternion about(const Vector3& axis, const PlaneTurn& half) {
  return {half.cosine, half.sine * axis.x(), half.sine * axis.y(), half.sine * axis.z()};
}

// Turns what hangs on a bone that is turned like that by so much in the world.
[[gnu::noinline]] void turn_on(const Quaternion& above, const Quaternion& turn, double* local) {
  const Vector3 seen = turned(above.conjugate(), turn.vec());
  store_quaternion(product({turn.w(), seen.x(), seen.y(), seen.z()}, load_quaternion(local)), local);
}

}  // namespace

void Lean::apply(const Skeleton& skeleton, WorldPose& pose, const Vector2& acceleration, const PlaneTurn& facing,
                 double part) {
  const Vector2 wanted = clamp_length(scale_ * acceleration, kHard);
  pushed_ += part * (wanted - pushed_);
  acceleration_ += part * (pushed_ - acceleration_);
  const double strength = acceleration_.norm();
  if (strength < kFloatRounding || trunk_.base < 0) return;
  const Vector2 lean = constants_.share * std::atan(strength / kGravity) / strength * acceleration_;
  lean_by(skeleton, lean, facing, pose.rotations.data());
}

// Forward from the hips on, and aside by the spine; the legs stay as they are. What is above is turned first, so that
// its sines and cosines are those of the others: hips that have not leaned yet see the axis of the spine turned back.
void Lean::lean_by(const Skeleton& skeleton, const Vector2& lean, const PlaneTurn& facing, double* rotations) const {
  static_assert(kHeadBack == 0.5, "hips turn by twice as much as the head turns back");
  const PlaneTurn back(kHeadBack * lean.y() / 2), spine(lean.x() / spine_bones(skeleton, trunk_) / 2);
  const PlaneTurn hips = back.twice(), whole = hips.twice();
  const Vector3 left{-facing.cosine, -facing.sine, 0},
      forward{-whole.cosine * facing.sine, whole.cosine * facing.cosine, whole.sine};
  const Quaternion aside = about(forward, spine);
  if (trunk_.head >= 0) {
    const Quaternion neck = bend(skeleton, skeleton.parents[trunk_.head], false, aside, rotations);
    const Quaternion aside_back = about(forward, PlaneTurn(-kHeadBack * lean.x() / 2));
    turn_on(neck, product(aside_back, about(left, back).conjugate()), &rotations[std::size_t{4} * trunk_.head]);
  } else {
    bend(skeleton, trunk_.chest, true, aside, rotations);
  }
  const Quaternion ahead = about(left, hips);
  for (const int thigh : thighs_) {
    if (thigh < 0) continue;
    const Quaternion above = world_turn(skeleton, skeleton.parents[thigh], rotations);
    turn_on(above, ahead.conjugate(), &rotations[std::size_t{4} * thigh]);
  }
  double* root = &rotations[std::size_t{4} * skeleton.roles.hips];
  store_quaternion(product(ahead, load_quaternion(root)), root);
}

// Turns the bones of the spine from its base up to a bone, or, where that is not of it yet, to the chest below. Returns
// how the bone was turned in the world.
Quaternion Lean::bend(const Skeleton& skeleton, int bone, bool in_spine, const Quaternion& turn,
                      double* rotations) const {
  double* local = &rotations[std::size_t{4} * bone];
  const Quaternion own = load_quaternion(local);
  if (bone == skeleton.roles.hips) return own;
  in_spine = in_spine || bone == trunk_.chest;
  const bool goes_on = in_spine && bone != trunk_.base;
  const Quaternion above = bend(skeleton, skeleton.parents[bone], goes_on, turn, rotations);
  if (in_spine) turn_on(above, turn, local);
  return product(above, own);
}

}  // namespace fragmotion

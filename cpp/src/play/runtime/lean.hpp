// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "motion/pose.hpp"
#include "motion/trunk.hpp"
#include "runtime/player_constants.hpp"
#include "skeleton/two_bone_ik.hpp"

namespace fragmotion {

/// m/s^2 of a 1.8 m character: what is more is hard.
constexpr double kHard = 6;

/// Leans a body that gets faster, slower or turns aside into its acceleration, as what pushes at its feet must not tip
/// it over: by part of the angle whose tangent is the acceleration over gravity, forward and backward from the hips on,
/// to the side by its spine, as hips that tilt would lift a foot. The head goes back by half of that. Does nothing to a
/// skeleton without a spine. Allocates nothing once it is made.
class Lean {
 public:
  /// `scale` as ControlSpace::scale().
  Lean(const Trunk& trunk, const Legs& legs, double scale, const LeanConstants& constants = {})
      : constants_(constants), trunk_(trunk), thighs_{legs[0].thigh, legs[1].thigh}, scale_(scale) {}

  /// Stands upright.
  void reset() { pushed_ = acceleration_ = Vector2::Zero(); }
  /// Which it has followed, m/s^2 of a 1.8 m character, in the character frame.
  const Vector2& acceleration() const { return acceleration_; }
  /// Changes the next pose that is shown, of a body that faces so and is accelerated by so many m/s^2 in the character
  /// frame; `part`: filtered() of LeanConstants::follows since the last one.
  void apply(const Skeleton& skeleton, WorldPose& pose, const Vector2& acceleration, const PlaneTurn& facing,
             double part);

 private:
  friend struct PlayerState;

  void lean_by(const Skeleton& skeleton, const Vector2& lean, const PlaneTurn& facing, double* rotations) const;
  Quaternion bend(const Skeleton& skeleton, int bone, bool in_spine, const Quaternion& turn, double* rotations) const;

  LeanConstants constants_;
  Trunk trunk_;
  std::array<int, 2> thighs_;
  double scale_;
  Vector2 pushed_ = Vector2::Zero(), acceleration_ = Vector2::Zero();  // halfway, and as the lean follows it
};

}  // namespace fragmotion

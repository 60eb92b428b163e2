// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <limits>

#include "fragments/gait_cycle.hpp"
#include "fragments/gait_edit.hpp"

namespace fragmotion {

/// The strides of a gait as its path is changed: what the balls of the feet do about their middle is turned and scaled
/// like the path, so that a foot that stood still on the old path does so on the new one. Where the feet would cross,
/// as strides do that are turned sideways, their middles go apart; and sideways feet do not roll from heel to toe, but
/// are lifted flat. Fore legs go as the path would of a body that begins with them: where hind ones turn, they
/// sidestep.
class Strides {
 public:
  /// Of a cycle whose hips are turned already as the edit says. `rate`: of the cycle as it is played, frames a second.
  Strides(const Kinematics& kinematics, const Legs& legs, const GaitCycle& cycle, const GaitEdit& edit, double rate);

  /// Changes the legs of a pose of the cycle.
  void change(BodyPose& body);

 private:
  // A foot as it stands flat: the lowest that it gets, and its toe relative to it.
  struct Flat {
    double height = std::numeric_limits<double>::infinity();  // m, of ankle and ball together
    Quaternion foot = Quaternion::Identity(), toe = Quaternion::Identity();
  };

  int count() const { return legs_.count(); }
  bool exist() const { return count() > 0; }
  double sideways() const { return edit_.direction - edit_.hips; }  // rad: the path against the hips
  void pose(const BodyPose& body);
  Vector2 balls(int side) const;
  Vector2 changed(int side) const;
  void find_fore_change(const GaitCycle& cycle, double rate);
  void find_flat(int side, const BodyPose& body);
  void set_apart(const GaitCycle& cycle);

  const Kinematics& kinematics_;
  const Legs& legs_;
  const GaitEdit& edit_;
  std::array<Vector2, kMostLegs> middles_{Vector2::Zero(), Vector2::Zero(), Vector2::Zero(), Vector2::Zero()};
  std::array<Flat, kMostLegs> flat_;
  Matrix2 fore_ = Matrix2::Identity();
  std::array<double, kMostLegs / 2> apart_{};  // m, of each pair
  PosedBones posed_;
};

}  // namespace fragmotion

// SPDX-License-Identifier: MIT
#pragma once

#include "control/control.hpp"

namespace fragmotion {

/// The command as a body can follow it: its velocity goes towards the stick's by so much a second at most, seen from
/// the world, so that a body that turns as it goes has less left for going faster.
class CommandLimit {
 public:
  /// `acceleration`: m/s^2 at most; infinity: none.
  explicit CommandLimit(double acceleration) : acceleration_(acceleration) {}

  double acceleration() const { return acceleration_; }
  void set_acceleration(double acceleration) { acceleration_ = acceleration; }

  /// Goes at `velocity`, m/s in the character frame, facing `heading`.
  void reset(double heading, const Vector2& velocity = Vector2::Zero());
  /// At which it goes, m/s in the character frame of a body that faces `heading`.
  Vector2 velocity(double heading) const;
  /// The control, no faster than the acceleration leads round the turn that it holds at `turn_rate` rad/s: v = a / w.
  /// What turns quicker than a full turn is over soon, and goes as fast as in one.
  Control round_turn(const Control& control, double turn_rate) const;
  /// What the control becomes `seconds` from the last advance(), of a body that faces `heading` then.
  Control after(const Control& control, double heading, double seconds) const;
  /// Goes so far. Returns the acceleration of the command, m/s^2 in the character frame.
  Vector2 advance(const Control& control, double heading, double seconds);

 private:
  friend struct PlayerState;

  Control limited(const Control& control, const Vector2& going, double seconds) const;

  double acceleration_;
  Vector2 velocity_ = Vector2::Zero();  // m/s, in the character frame
  double heading_ = 0;                  // of that frame, rad
};

}  // namespace fragmotion

// SPDX-License-Identifier: MIT
#pragma once

#include "control/control.hpp"

namespace fragmotion {

/// The command as a body can follow it: its velocity goes towards the stick's by so much a second at most, seen from
/// the world, so that a body that turns as it goes has less left for going faster; and it is no faster than the
/// acceleration leads round the turn that is asked for: v = a / w. What turns quicker than a full turn is over soon,
/// and goes as fast as in one.
class CommandLimit {
 public:
  /// `acceleration`: m/s^2 at most; infinity: none. `turn_rate`: rad/s at a control's turn of 1.
  CommandLimit(double acceleration, double turn_rate) : acceleration_(acceleration), turn_rate_(turn_rate) {}

  double acceleration() const { return acceleration_; }
  void set_acceleration(double acceleration) { acceleration_ = acceleration; }
  void set_turn_rate(double turn_rate) { turn_rate_ = turn_rate; }

  /// Goes at `velocity`, m/s in the character frame, facing `heading`.
  void reset(double heading, const Vector2& velocity = Vector2::Zero());
  /// Sees itself from now on from a body that faces `heading`, which what follows asks for at less cost.
  void face(double heading);
  /// At which it goes, m/s in the character frame of a body that faces `heading`.
  Vector2 velocity(double heading) const;
  /// What the control becomes `seconds` from the last advance(), of a body that faces `heading` then.
  Control after(const Control& control, double heading, double seconds) const;
  /// Goes so far. Returns the acceleration of the command, m/s^2 in the character frame, of a body that turns as it
  /// says: how the heading sways about that in each stride is none.
  Vector2 advance(const Control& control, double heading, double seconds);

 private:
  friend struct PlayerState;

  Control round_turn(const Control& control) const;
  Control limited(const Control& given, const Vector2& going, double seconds) const;

  double acceleration_, turn_rate_;
  Vector2 velocity_ = Vector2::Zero();  // m/s, in the character frame
  double heading_ = 0;                  // of that frame, rad
  Vector2 before_ = Vector2::Zero();    // the velocity, as a body that turned as asked would still see it
};

}  // namespace fragmotion

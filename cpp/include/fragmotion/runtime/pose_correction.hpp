// SPDX-License-Identifier: MIT
#pragma once

#include "fragmotion/runtime/breathing.hpp"
#include "fragmotion/runtime/playback.hpp"

namespace fragmotion {

/// Corrects what fragments show: the root goes more as the control says and no faster away from its velocity than a
/// body can, it keeps the heading that the control leads to, a body that stands breathes (breathing.hpp), and planted
/// feet stay where they are (foot_lock.hpp). Allocates nothing once it is made.
class PoseCorrection {
 public:
  /// `root_adjustment` and `lock_feet` as in PlayerOptions; `acceleration` of a body at most, m/s^2. Character and
  /// workspace must outlive it.
  PoseCorrection(const Character& character, Workspace& workspace, double root_adjustment, double acceleration,
                 bool lock_feet);

  void reset(double heading);
  /// Lets the root keep the velocity by which it was faster than what begins to play, m/s in the character frame.
  void keep_velocity(const Vector2& faster) { velocity_ += faster; }
  /// Moves and turns what plays over `seconds`, so that it does more of what the control says.
  void adjust_root(const Control& control, double seconds, Playback& playback);
  /// Corrects Workspace::shown, `seconds` after the pose that was shown last.
  void correct(const Playback& playback, double seconds);

 private:
  Vector2 velocity_to_add(const Control& control, const Control& evident) const;
  double turn_to_add(const Control& control, const Playback& playback, double seconds);
  bool stands(const Control& evident) const;
  void lock_feet(const Playback& playback, double seconds);

  const Character* character_;
  Workspace* workspace_;
  double root_adjustment_, acceleration_;
  bool lock_feet_;
  Vector2 velocity_ = Vector2::Zero();  // of the adjustment, m/s, in the character frame
  double turn_rate_ = 0;                // of the adjustment, rad/s
  double led_ = 0;                      // the heading that the controls lead to, rad
  FootLock foot_lock_;
  Breathing breathing_;
};

}  // namespace fragmotion

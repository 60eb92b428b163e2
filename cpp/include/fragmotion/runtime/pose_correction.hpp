// SPDX-License-Identifier: MIT
#pragma once

#include "fragmotion/runtime/breathing.hpp"
#include "fragmotion/runtime/playback.hpp"

namespace fragmotion {

/// Corrects what fragments show: the root goes more as the control says, a body that stands breathes (breathing.hpp),
/// and planted feet stay where they are (foot_lock.hpp). Allocates nothing once it is made.
class PoseCorrection {
 public:
  /// `root_adjustment` and `lock_feet` as in PlayerOptions. Character and workspace must outlive it.
  PoseCorrection(const Character& character, Workspace& workspace, double root_adjustment, bool lock_feet);

  void reset();
  /// Moves and turns what plays over `seconds`, so that it does more of what the control says.
  void adjust_root(const Control& control, double seconds, Playback& playback);
  /// Corrects Workspace::shown, `seconds` after the pose that was shown last.
  void correct(const Playback& playback, double seconds);

 private:
  bool stands(const Control& evident) const;
  void lock_feet(const Playback& playback, double seconds);

  const Character* character_;
  Workspace* workspace_;
  double root_adjustment_;
  bool lock_feet_;
  Vector2 velocity_ = Vector2::Zero();  // of the adjustment, m/s, in the character frame
  double turn_rate_ = 0;                // of the adjustment, rad/s
  FootLock foot_lock_;
  Breathing breathing_;
};

}  // namespace fragmotion

// SPDX-License-Identifier: MIT
#pragma once

#include "runtime/lean.hpp"
#include "runtime/root_governor.hpp"

namespace fragmotion {

/// Lets the pose go with the root: a body that is accelerated leans (lean.hpp) and sets its feet for it, steps are as
/// long as the way that the root goes in them, and planted feet stay where they are (foot_lock.hpp). Allocates nothing
/// once it is made.
class PoseCorrection {
 public:
  /// `lock_feet` as in PlayerOptions. Character and workspace must outlive it.
  PoseCorrection(const Character& character, Workspace& workspace, bool lock_feet);

  void reset();
  /// As it was told when it was made. Feet that were held and are not any more are free.
  /// Whether steps are as long as the way, too.
  void set_feet(bool lock, bool edit);
  const StepEdit& steps() const { return steps_; }
  /// Whether a foot stands: it is held where it is, or, where feet are not held, it is to stand.
  bool plants(int side, bool stands) const { return lock_feet_ ? foot_lock_.locked(side) : stands; }
  /// What holds its feet, or null.
  const FootLock* foot_lock() const { return lock_feet_ ? &foot_lock_ : nullptr; }
  void prefetch() const { foot_lock_.prefetch(); }
  /// Corrects Workspace::shown, `seconds` after the pose that was shown last.
  /// On even ground feet roll as in the takes; on uneven ground they are held for all of a contact.
  void correct(const Playback& playback, const RootGovernor& governor, bool even, double seconds);

 private:
  friend struct PlayerState;

  Footwork edit_steps(const Control& evident, const RootGovernor& governor, double seconds);
  void lock_feet(const Playback& playback, bool even, double seconds, const Footwork& work);

  Workspace* workspace_;
  double scale_;
  bool lock_feet_, edit_steps_ = true;
  StepEdit steps_;
  FootLock foot_lock_;
  Lean lean_;
};

}  // namespace fragmotion

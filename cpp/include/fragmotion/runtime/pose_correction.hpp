// SPDX-License-Identifier: MIT
#pragma once

#include "fragmotion/runtime/lean.hpp"
#include "fragmotion/runtime/playback.hpp"

namespace fragmotion {

/// Corrects what fragments show: the root goes more as the control says and no faster away from its velocity than a
/// body can, it keeps its target heading, a body that is accelerated leans (lean.hpp) and sets its feet for it, and
/// planted feet stay where they are (foot_lock.hpp). Allocates nothing once it is made.
class PoseCorrection {
 public:
  /// By which the adjustment of the velocity lags behind what it is told, s.
  static constexpr double kLag = 0.03;

  /// `root_adjustment` and `lock_feet` as in PlayerOptions; `acceleration` of a body at most, m/s^2. Character and
  /// workspace must outlive it.
  PoseCorrection(const Character& character, Workspace& workspace, double root_adjustment, double acceleration,
                 bool lock_feet);

  void reset(double heading);
  /// Controls are asked of this style from now on.
  void change_style(const Character& style) { space_ = &style.space; }
  /// Lets the root keep the velocity by which it was faster than what begins to play, m/s in the character frame.
  void keep_velocity(const Vector2& faster) {
    velocity_ += faster;
    begins_ = true;
  }
  /// How much faster than captured what plays is to be played, 0.75 to 1.2: where the control is slower or faster than
  /// the fragment, its steps make up for half of that by following each other later or sooner, and for the rest by
  /// being shorter or longer.
  double tempo() const { return tempo_; }
  /// Of the root beyond what plays: m/s in the character frame, and rad/s.
  const Vector2& velocity() const { return velocity_; }
  double turn_rate() const { return turn_rate_; }
  const StepEdit& steps() const { return steps_; }
  /// Whether a foot stands: it is held where it is, or, where feet are not held, it is to stand and is low.
  bool plants(int side, bool stands) const { return lock_feet_ ? foot_lock_.locked(side) : stands; }
  /// Of a foot that is held, as FootLock has it.
  Vector2 coming_to_rest(int side) const { return lock_feet_ ? foot_lock_.coming_to_rest(side) : Vector2::Zero(); }
  double stepping(int side) const { return lock_feet_ ? foot_lock_.stepping(side) : 0; }
  /// Moves and turns what plays over `seconds`, so that it does more of what the control says.
  void adjust_root(const Control& control, double seconds, Playback& playback);
  /// Lets what plays go its own way over `seconds`: the velocity that was kept and the adjustment's fade.
  void leave_root(double seconds, Playback& playback);
  /// Corrects Workspace::shown, `seconds` after the pose that was shown last, of a body that is accelerated by so many
  /// m/s^2 in the character frame.
  void correct(const Playback& playback, const Vector2& acceleration, double seconds);

 private:
  void adjust_tempo(const Control& control, const Control& evident, double seconds);
  Vector2 velocity_to_add(const Control& control, const Vector2& velocity) const;
  void adjust_velocity(const Control& control, double seconds, const Playback& playback);
  double turn_to_add(const Control& control, const Playback& playback, double seconds);
  void edit_steps(const Control& evident, double seconds);
  void lock_feet(const Playback& playback, double seconds);

  const ControlSpace* space_;  // of the style that plays
  Workspace* workspace_;
  double root_adjustment_, acceleration_;
  Vector2 velocity_ = Vector2::Zero();  // of the adjustment, m/s, in the character frame
  Vector2 played_ = Vector2::Zero();    // m/s, at which the hips of what plays went last,
  bool begins_ = true;                  // but for when it has just begun
  double turn_rate_ = 0;                // of the adjustment, rad/s
  double tempo_ = 1;
  double target_heading_ = 0;  // rad: what the turn rates that were asked for add up to
  bool lock_feet_;
  StepEdit steps_;
  FootLock foot_lock_;
  Lean lean_;
};

}  // namespace fragmotion

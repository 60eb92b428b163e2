// SPDX-License-Identifier: MIT
#pragma once

#include "control/command_limit.hpp"
#include "runtime/playback.hpp"
#include "runtime/player_constants.hpp"

namespace fragmotion {

/// Says where the body goes (a reference governor: E. Garone, S. Di Cairano, I. Kolmanovsky, "Reference and command
/// governors for systems with constraints", Automatica 75, 2017): it limits what is asked to what a body can do, and
/// draws the mean of the strides to that within half a step, so that what the hips do within a stride stays the
/// actor's. Nothing else moves or turns what plays. Allocates nothing.
class RootGovernor {
 public:
  /// `root_adjustment` and `responsiveness` as in PlayerOptions. The character, the limits and the filter of what
  /// settles must outlive it.
  RootGovernor(const Character& character, const RootLimits& limits, Filter& settles, double root_adjustment,
               double responsiveness);

  /// As it was told when it was made.
  void set(double root_adjustment, double responsiveness);
  /// Stands.
  void reset(double heading);
  /// Controls are asked of this style from now on.
  void change_style(const Character& style) {
    space_ = &style.space;
    limit_.set_turn_rate(space_->turn_rate());
  }
  /// What is asked of a body that goes so, m/s in the character frame, begins anew.
  void resume(double heading, const Vector2& velocity) { limit_.reset(heading, velocity); }
  /// Lets the root keep the velocity by which what played was faster than what begins to, m/s in the character frame.
  /// Of that by which the one ended quicker than its mean and the other begins slower no more is kept than fades while
  /// what begins plays, and by no more than that a body gets faster than it went, begins to go, or is commanded.
  void keep(const Vector2& faster, const Playback& playback);

  /// The body faces `heading`.
  void face(double heading) { limit_.face(heading); }
  /// What a body that faces `heading` can do of a control in so many seconds from now.
  Control command(const Control& control, double heading, double seconds) const {
    return limit_.after(control, heading, seconds);
  }
  /// What it is commanded now, m/s, as its body faces `heading`.
  Vector2 commanded(double heading) const { return limit_.velocity(heading); }
  /// Of the command, m/s^2 in the character frame; 0 in the air and in moves.
  const Vector2& acceleration() const { return acceleration_; }
  /// How much faster than captured what plays is to be played: half of what the control is slower or faster than the
  /// fragment is made up for by steps that follow each other later or sooner, the rest by shorter or longer ones.
  double tempo() const { return tempo_; }
  /// The same at this moment: where steps are so slow, legs swing sooner, and both feet stand the longer.
  double pace() const { return tempo_ * quicker_; }
  /// Whether both feet are to stand for longer than captured, or do.
  bool rests() const { return ahead_ > 0; }
  /// Of the root beyond what plays: m/s in the character frame, and rad/s.
  const Vector2& velocity() const { return velocity_; }
  double turn_rate() const { return turn_rate_; }

  /// Moves and turns what plays, which went on for `seconds`, so that it does more of what the control says.
  void steer(const Control& control, double seconds, Playback& playback);
  /// Lets what plays go its own way over `seconds`: what was kept and added fades.
  void leave(double seconds, Playback& playback);

 private:
  friend struct PlayerState;

  void steer_tempo(const Control& command, const Playback& playback, double seconds);
  void steer_pace(const Playback& playback, const Travel& mean, double settled, double seconds);
  void steer_velocity(const Control& command, const Vector2& mean, bool in_the_air, double settled, double seconds);
  void steer_turn(double asked, double mean, const Playback& playback, double settled, double seconds);
  Vector2 velocity_to_add(const Control& command, const Vector2& mean) const;

  const RootLimits* limits_;
  Filter* settles_;
  const ControlSpace* space_;  // of the style that plays
  double root_adjustment_;
  CommandLimit limit_;
  Vector2 acceleration_ = Vector2::Zero();
  Vector2 velocity_ = Vector2::Zero();  // that is added, m/s, in the character frame
  Vector2 played_ = Vector2::Zero();    // m/s, of what played last,
  bool begins_ = true;                  // but for when it has just begun
  double turn_rate_ = 0;                // that is added, rad/s
  double tempo_ = 1;
  double quicker_ = 1;         // the pace over the tempo,
  double ahead_ = 0;           // and s of what plays by which it has got ahead of that
  double target_heading_ = 0;  // rad: what the turn rates that were asked for add up to
};

}  // namespace fragmotion

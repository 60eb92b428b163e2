// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "base/random.hpp"
#include "runtime/playback.hpp"

namespace fragmotion {

/// When to leave what plays for a class.
struct Exit {
  int next_class = -1;  ///< -1: none is planned
  double seconds = 0;   ///< Since the first pose of the fragment that plays.
  double cost = 0;      ///< Of the stitch and of waiting, m a metre of tip_reach().
};

/// Chooses the member of a class that is played: at random (Sec. 3.1) among those that perform the control nearly as
/// well and as steadily as any does and join on well. Allocates nothing once it is made.
class FragmentSelector {
 public:
  static constexpr float kNearly = 0.8F;  ///< error() more than the least, which the root makes up for.

  /// Chooses from the first style. The workspace and its character must outlive it.
  FragmentSelector(Workspace& workspace, std::uint64_t seed);

  /// Draws from the seed again.
  void reset() { random_ = Random(seed_); }
  /// Draws from another seed, from the next reset on.
  void reseed(std::uint64_t seed) { seed_ = seed; }
  /// What is chosen from now on is of this style.
  void change_style(int style);
  /// The fragment with which the take of a fragment goes on, where it performs the control, by ControlDis alone, as
  /// well as a member of the class must that is chosen; otherwise -1. Nothing is to be stitched there, and how steady
  /// and how long it is is the actor's.
  int continuation(int fragment, int next_class, const Control& control) const;
  /// Whether a class answers() a control, if that asks for motion.
  bool goes_as_asked(int of_class, const Control& control) const;
  /// The class of a fragment.
  int class_of(int fragment) const { return style_->character->classes.labels[fragment]; }
  /// The member to play after what plays now.
  int choose(int next_class, const Control& control, const Playback& playback);
  /// Any member.
  int choose_any(int next_class);

  /// How far a fragment is from performing a control: its ControlDis, and more the less steady and the shorter it is. A
  /// control that changes comes here step by step (CommandLimit), so that fragments which get faster or slower limp
  /// through one that is held; and parts of a step bring a stitch the more.
  float error(int fragment, const Control& control) const;

  /// The class to enter, in the shown pose, after what was no fragment: of the greatest Eq. 2 for the control.
  int best_class(const Control& control, const Playback& playback) const;
  /// How badly the best member of a class joins on to what is shown, m a metre of tip_reach(), of places, speeds and
  /// steps.
  double distance_to_class(int next_class, const Control& control, const Playback& playback) const;
  /// The same after a fragment that is played to its end, which begins after these steps.
  double distance_after(int fragment, int next_class, const Control& control, StepSequence steps) const;
  /// How badly a move joins on to what is shown, m a metre of tip_reach(), of places and speeds.
  double distance_to(int move, const Playback& playback) const;

  /// For each of two classes (-1: none) the moment at which what plays is best left for it, s since the fragment's
  /// first pose: every second of waiting costs as much as `haste` metres a metre of tip_reach() between the poses that
  /// are joined.
  std::array<Exit, 2> best_exits(const std::array<int, 2>& classes, const Control& control, const Playback& playback,
                                 double haste) const;

 private:
  friend struct PlayerState;

  CharacterFrame pose_tips(const Playback& playback, double seconds, BodyTips& tips) const;
  void extrapolate(const CharacterFrame& frame, const BodyTips& before, const BodyTips& now) const;
  void extrapolate(const Playback& playback) const;
  void extrapolate_end(const Fragment& fragment) const;
  bool goes_as_asked(const Control& evident, const Control& control) const;
  float find_candidates(int next_class, const Control& control, Candidates& candidates) const;
  float measure_candidates(const Control& evident, const StepSequence& steps, Candidates& candidates) const;

  Workspace* workspace_;
  const FragmentLists* style_;  // that is chosen from
  std::uint64_t seed_;
  Random random_;
};

}  // namespace fragmotion

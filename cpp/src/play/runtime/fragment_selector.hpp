// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <limits>

#include "base/random.hpp"
#include "runtime/playback.hpp"

namespace fragmotion {

/// When to leave what plays for a class.
struct Exit {
  int next_class = -1;  ///< -1: none is planned
  double seconds = 0;   ///< Since the first pose of the fragment that plays.
  double cost = 0;      ///< TransitionCost, waiting included.
};

/// What it costs to play a member of a class or of a gait.
struct Cost {
  float whole = 0;    ///< TransitionCost of the one for which it is least,
  float then = 0;     ///< and of what follows it: its successor or, where there is none, as much again.
  int fragment = -1;  ///< That one, and
  int of_class = -1;  ///< of which class or gait it is played.

  float both() const { return whole + then; }
};

/// Chooses the member of a class that is played: at random (Sec. 3.1) among those that cost nearly as little as any
/// (transition_cost.hpp). Allocates nothing once it is made.
class FragmentSelector {
 public:
  static constexpr float kAny = std::numeric_limits<float>::infinity();  ///< Of any cost.

  /// Chooses from the first style. The workspace and its character must outlive it.
  FragmentSelector(Workspace& workspace, std::uint64_t seed);

  /// Draws from the seed again.
  void reset() { random_ = Random(seed_); }
  /// Draws from another seed, from the next reset on.
  void reseed(std::uint64_t seed) { seed_ = seed; }
  /// What is chosen from now on is of this style.
  void change_style(int style);
  /// The fragment with which the take of a fragment goes on, where the policy may play it, and it jumps or does not,
  /// and goes, or stands or brakes, as asked; otherwise -1.
  int successor(int fragment, const Control& control) const;
  const TransitionWeights& weights() const { return workspace_->constants.transition; }
  /// What it costs that the take goes on with a fragment under a control.
  float cost_of_going_on(int fragment, const Control& control) const {
    return style_->cost.of_going_on(fragment, control);
  }
  /// The gait of a control, by a number as of a class; -1: there is none, or the fragment is of it.
  int gait_beside(int fragment, const Control& control) const;
  /// The class of a fragment.
  int class_of(int fragment) const { return style_->character->classes.labels[fragment]; }
  /// The member to play after what plays now: as it joins on to that, or, where it is not `posed`, as its class does.
  int choose(int next_class, const Control& control, const Playback& playback, bool posed = true);
  /// Any member.
  int choose_any(int next_class);

  /// The class to enter, in the shown pose, after what was no fragment: of the greatest Eq. 2 for the control.
  int best_class(const Control& control, const Playback& playback) const;
  /// What it costs to play a class after what is shown: the least of these, with what follows, if that is less than
  /// `enough`; else no fragment.
  Cost cost_of_leaving(const std::array<int, 2>& classes, const Control& control, const Playback& playback,
                       float enough = kAny) const;
  /// What it costs that a class's representative follows that of another (Eq. 2).
  float usual_cost(int of_class, int next_class, const Control& control) const;
  /// What it costs to join a move on to what is shown.
  double distance_to(int move, const Playback& playback) const;

  /// When what plays is best left for one of two classes, of which each costs more by its `cost` (class -1: none),
  /// where every second of waiting costs `haste`; `best` where no exit costs less than that. Where it is asked only
  /// whether that is now, any later one that costs less than now's, which takes fewer moments to look at.
  Exit best_exit(const std::array<Exit, 2>& classes, const Control& control, const Playback& playback, double haste,
                 Exit best, bool only_now = false) const;

 private:
  friend struct PlayerState;

  // What is left, and the contacts of its clip.
  struct Left {
    const Fragment& fragment;
    const Contacts& contacts;
  };

  CharacterFrame pose_tips(const Playback& playback, double seconds, BodyTips& tips) const;
  void extrapolate(const CharacterFrame& frame, const BodyTips& before, const BodyTips& now) const;
  void extrapolate(const Playback& playback) const;
  bool is_moving(const Control& evident) const;
  void find_candidates(int next_class, const Control& control, const Left& left, Candidates& candidates) const;
  float distance(int fragment) const;
  int out_of_turn(const Entrants& entrants, int member, bool went, const StepSequence& steps) const;
  float least_cost(int next_class, const Control& evident, const StepSequence& steps, Candidates& candidates,
                   float most) const;

  Workspace* workspace_;
  const FragmentLists* style_;  // that is chosen from
  std::uint64_t seed_;
  Random random_;
};

}  // namespace fragmotion

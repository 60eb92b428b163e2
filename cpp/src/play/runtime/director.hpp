// SPDX-License-Identifier: MIT
#pragma once

#include "runtime/fragment_selector.hpp"

namespace fragmotion {

/// Decides which class is played next, and when (Sec. 3.3): at a fragment's end what the table tells, or the
/// stand-in-place class between; before it, unless in the air, when the control changes a lot. A jump that is pressed,
/// however shortly, is latched until the decision that plays it; held on, it is one jump. Allocates nothing.
class Director {
 public:
  /// `responsiveness` as PlayerOptions::responsiveness. Character and policy must outlive it.
  Director(const Character& character, const Policy& policy, double responsiveness);

  /// As PlayerOptions::responsiveness.
  void set_responsiveness(double responsiveness);
  /// Whether it leaves what plays before its end, and looks for when; else it looks up what follows at its end.
  void set_plans(bool plans) { plans_ = plans; }
  /// Plays the class that best performs standing still.
  void reset();
  /// Decides among another style's classes from now on, by its policy; a class that was forced is forgotten. resume()
  /// or reset() follows.
  void change_style(const Character& style, const Policy& policy);
  /// Takes notice of a control: a jump that is pressed is latched.
  void observe(const Control& control);
  /// The control with the latched jump.
  Control wanted(const Control& control) const;

  /// Whether a decision is due: what plays ends, is left early, or makes way for a forced class.
  /// `changes`: the control is another one the next time, so that nothing is planned ahead for it.
  bool is_due(const Control& control, bool changes, const Playback& playback, const FragmentSelector& selector);
  /// The fragment with which the take that plays goes on at its end, or one of the gait of the control
  /// (held_gaits.hpp), where that costs no more (transition_cost.hpp) than what the policy tells; otherwise -1.
  int continuation(const Control& control, const Playback& playback, FragmentSelector& selector) const;
  /// Decides on the class that plays from now on, which it returns.
  int decide(const Control& control, const Playback& playback, const FragmentSelector& selector);
  /// Plays this class from now on, without a decision.
  void resume(int next_class, const Control& control);
  /// Seconds until the next moment at which a decision may be due, at most `most`.
  double until_due(const Playback& playback, double most) const;

  /// Plays this class next, whatever the policy says: as soon as the stitch under way is done, and to its end.
  void force(int next_class) { forced_ = next_class; }
  /// Whether the class that plays was forced: any of its members will do.
  bool plays_forced() const { return plays_forced_; }

  int playing_class() const { return class_; }
  int previous_class() const { return previous_; }

 private:
  friend struct PlayerState;

  double soonest(const Playback& playback) const;
  bool makes_way(const Playback& playback) const;
  bool leaves_early(const Control& wanted, bool changes, const Playback& playback, const FragmentSelector& selector);
  bool has_changed(const Control& wanted) const;
  int look_up_class(int playing, const Control& wanted) const;
  int class_after(int next, const Control& wanted) const;
  int bridge_between(int previous, int next) const;
  bool is_planned(const Control& wanted) const;
  Exit plan_exit(const Control& wanted, const Playback& playback, const FragmentSelector& selector,
                 bool only_now = false) const;
  int next_class(const Control& control, const Playback& playback, const FragmentSelector& selector);

  const Character* character_;
  const Policy* policy_;
  double haste_ = 0;
  bool plans_ = true;
  int class_ = 0, previous_ = 0;
  int waiting_ = -1;  // the class that follows a stand-in-place fragment
  int forced_ = -1;   // the class that force() asked for and that does not play yet
  bool plays_forced_ = false;
  double soonest_ = 0;  // s after which what plays may be left early
  Control decided_for_;
  Control planned_for_;
  Exit exit_;  // for planned_for_
  bool jump_pressed_ = false, jump_latched_ = false;
};

}  // namespace fragmotion

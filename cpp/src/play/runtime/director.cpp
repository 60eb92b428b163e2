// SPDX-License-Identifier: MIT
#include "runtime/director.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "base/rates.hpp"
#include "base/rounding.hpp"
#include "fragments/entry_poses.hpp"

namespace fragmotion {

Director::Director(const Character& character, const Policy& policy, double responsiveness)
    : character_(&character), policy_(&policy) {
  set_responsiveness(responsiveness);
}

void Director::set_responsiveness(double responsiveness) {
  haste_ = responsiveness / std::max(1 - responsiveness, kRounding);
}

void Director::reset() {
  const Quality& quality = character_->quality;
  const int still = character_->space.nearest({});
  class_ = 0;
  for (int k = 1; k < quality.classes; ++k) {
    const auto match = [&](int q) { return quality.match[static_cast<std::size_t>(q) * quality.controls + still]; };
    if (match(k) > match(class_)) class_ = k;
  }
  previous_ = class_;
  waiting_ = forced_ = -1;
  plays_forced_ = false;
  soonest_ = 0;
  exit_ = {};
  jump_latched_ = jump_pressed_ = false;
  decided_for_ = {};
}

void Director::change_style(const Character& style, const Policy& policy) {
  character_ = &style;
  policy_ = &policy;
  forced_ = -1;
}

void Director::observe(const Control& control) {
  const bool pressed = control.jumps();
  jump_latched_ = jump_latched_ || (pressed && !jump_pressed_);
  jump_pressed_ = pressed;
}

Control Director::wanted(const Control& control) const {
  Control wanted = control;
  wanted.jump = jump_latched_ ? 1 : 0;
  return wanted;
}

double Director::soonest(const Playback& playback) const { return std::max(soonest_, playback.faded()); }

bool Director::has_changed(const Control& wanted) const {
  return character_->space.distance(wanted, decided_for_) > kChange;
}

// Whatever is to go slower than the slowest speed goes at that.
int Director::look_up_class(int playing, const Control& wanted) const {
  const ControlSpace& space = character_->space;
  Control asked = wanted;
  const double speed = wanted.speed();
  if (space.asks_to_go(wanted) && speed < space.slowest()) {
    asked.x *= space.slowest() / speed;
    asked.y *= space.slowest() / speed;
  }
  return (*policy_)(playing, space.nearest(asked));
}

// Of a jump, that with which it would begin after one more step: off the other foot.
int Director::class_after(int next, const Control& wanted) const {
  if (!wanted.jumps()) return look_up_class(next, wanted);
  return look_up_class(look_up_class(class_, {wanted.x, wanted.y, wanted.turn, 0}), wanted);
}

int Director::bridge_between(int previous, int next) const {
  return character_->bridges[static_cast<std::size_t>(previous) * character_->classes.count + next];
}

bool Director::is_planned(const Control& wanted) const {
  return exit_.next_class >= 0 && character_->space.distance(wanted, planned_for_) < kFloatRounding;
}

int Director::next_class(const Control& control, const Playback& playback, const FragmentSelector& selector) {
  const Control wanted = this->wanted(control);
  const int waiting = std::exchange(waiting_, -1);
  int next = waiting;
  if (waiting < 0 || has_changed(wanted)) {
    decided_for_ = wanted;
    if (!plans_) {
      next = look_up_class(class_, wanted);
    } else {
      next = (is_planned(wanted) ? exit_ : plan_exit(wanted, playback, selector)).next_class;
    }
    const int bridge = bridge_between(class_, next);
    // The jump, too, waits for the end of the stand-in-place fragment.
    if (bridge >= 0) return waiting_ = next, bridge;
  }
  jump_latched_ = false;
  decided_for_.jump = 0;
  return next;
}

bool Director::makes_way(const Playback& playback) const {
  return forced_ >= 0 && playback.seconds() > soonest(playback) - kRounding;
}

bool Director::leaves_early(const Control& wanted, bool changes, const Playback& playback,
                            const FragmentSelector& selector) {
  const bool too_soon = playback.seconds() <= soonest(playback) - kRounding;
  if (!plans_ || too_soon || playback.left() <= kMomentsApart || waiting_ >= 0 || plays_forced_) return false;
  if (playback.is_jumping() || !has_changed(wanted)) return false;
  if (!is_planned(wanted)) {
    // It will be planned anew: one part of a step plays no more of a fragment than two frames of a game.
    const bool only_now = changes && playback.left() > kMomentsApart + 2 * kGameStep;
    const Exit found = plan_exit(wanted, playback, selector, only_now);
    exit_ = only_now && found.seconds > playback.seconds() ? Exit{} : found;
    planned_for_ = wanted;
  }
  return exit_.next_class >= 0 && playback.seconds() > exit_.seconds - kRounding;
}

// Where what plays is left in the middle of a step, or at the end of its take, the class that the table gives may begin
// with the wrong foot: then the one after it is entered. Or it is left at its end, where its take does what is
// wanted by itself.
Exit Director::plan_exit(const Control& wanted, const Playback& playback, const FragmentSelector& selector,
                         bool only_now) const {
  const int next = look_up_class(class_, wanted), after = class_after(next, wanted);
  const bool may_skip = after != next && bridge_between(class_, next) < 0 && bridge_between(class_, after) < 0;
  const TransitionWeights& weights = selector.weights();
  const Control& told = character_->pool.fragments[character_->classes.representatives[next]].evident;
  const double haste = haste_ * weights.wait * character_->space.distance(playback.evident(), told);
  const int found = selector.successor(playback.number(), wanted);
  Exit stays{next, playback.seconds() + playback.left(), std::numeric_limits<double>::infinity()};
  if (found >= 0) stays.cost = haste * playback.left() + selector.cost_of_going_on(found, wanted);
  return selector.best_exit({Exit{next, 0, 0}, Exit{may_skip ? after : -1, 0, weights.skip}}, wanted, playback, haste,
                            stays, only_now);
}

bool Director::is_due(const Control& control, bool changes, const Playback& playback,
                      const FragmentSelector& selector) {
  return makes_way(playback) || playback.left() < kRounding ||
         leaves_early(wanted(control), changes, playback, selector);
}

// What plays for the time of two fragments is compared: the take's next one and then the one after it, with what the
// policy tells or the gait of the control, which is entered now and goes on in its own take. The last fragment of a
// take leads to nothing: it is not gone on with. A gait that is held varies; another take's is entered as it joins
// best.
int Director::continuation(const Control& control, const Playback& playback, FragmentSelector& selector) const {
  if (makes_way(playback) || playback.left() > kRounding) return -1;
  const Control wanted = this->wanted(control);
  const int found = selector.successor(playback.number(), wanted);
  if (found < 0 && !plans_) return -1;
  const int next = waiting_ >= 0 && !has_changed(wanted) ? waiting_ : look_up_class(class_, wanted);
  const float staying = found < 0 ? FragmentSelector::kAny : selector.cost_of_going_on(found, wanted);
  if (!plans_) return staying <= selector.usual_cost(class_, next, wanted) ? found : -1;
  const int second = found < 0 ? -1 : selector.successor(found, wanted), gait = selector.gait_beside(found, wanted);
  const float going_on = second < 0 ? FragmentSelector::kAny : staying + selector.cost_of_going_on(second, wanted);
  const Cost left = selector.cost_of_leaving({next, gait}, wanted, playback, going_on);
  if (left.fragment < 0) return found;
  if (left.of_class != gait) return -1;
  const std::vector<Fragment>& fragments = character_->pool.fragments;
  const bool is_held = fragments[playback.number()].clip == fragments[left.fragment].clip;
  return is_held ? selector.choose(gait, wanted, playback) : left.fragment;
}

int Director::decide(const Control& control, const Playback& playback, const FragmentSelector& selector) {
  plays_forced_ = makes_way(playback);
  if (plays_forced_) waiting_ = -1;
  const int next = plays_forced_ ? std::exchange(forced_, -1) : next_class(control, playback, selector);
  previous_ = std::exchange(class_, next);
  exit_ = {};
  soonest_ = kEntry;
  return next;
}

void Director::resume(int next_class, const Control& control) {
  previous_ = std::exchange(class_, next_class);
  decided_for_ = wanted(control);
  decided_for_.jump = 0;
  waiting_ = -1;
  plays_forced_ = jump_latched_ = false;
  exit_ = {};
  soonest_ = kEntry;
}

double Director::until_due(const Playback& playback, double most) const {
  if (!plans_) return std::min(most, playback.left());
  const auto until = [&](double time) {
    return time - playback.seconds() > kRounding ? time - playback.seconds() : most;
  };
  return std::min({most, playback.left(), until(soonest(playback)), until(exit_.next_class < 0 ? -1 : exit_.seconds)});
}

}  // namespace fragmotion

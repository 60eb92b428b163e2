// SPDX-License-Identifier: MIT
#include <algorithm>

#include "base/rates.hpp"
#include "base/rounding.hpp"
#include "runtime/plan_moment.hpp"

namespace fragmotion {
void Player::change_style(int style) {
  check_style(*character_, style);
  if (extras_ == nullptr) return;
  extras_->style.waiting = style == playing_style() ? -1 : style;
  extras_->style.moment.await(kStyleWait);
}

// What is begun from now on is of this style.
void Player::set_style(int style) {
  const Character& character = character_->in_style(style);
  director_.change_style(character, character.policies[extras_->policy]);
  selector_.change_style(style);
  playback_.change_style(style);
  governor_.change_style(character);
  extras_->style.playing = style;
  extras_->style.waiting = -1;
}

Control Player::wanted(const Control& control) const {
  return director_.wanted(governor_.command(control, frame().heading, kGameStep));
}

// What it costs to play on in another style.
double Player::cost_of_style(int style, const Control& wanted) const {
  FragmentSelector there = selector_;
  there.change_style(style);
  return there.cost_of_leaving({there.best_class(wanted, playback_), -1}, wanted, playback_).whole;
}

bool Player::can_change_style() const { return playback_.has_landed() && is_stitched(); }

// Begins the style that waits, where its moment has come. Returns as begin_moves().
double Player::begin_style(const Control& control, double most) {
  const int style = waiting_style();
  if (style < 0 || extras_->whole_body.plays()) return most;
  Moment& moment = extras_->style.moment;
  if (moment.needs_plan(control, styled_character().space)) {
    plan(moment, control, &Player::can_change_style,
         [&](const Player& p) { return p.cost_of_style(style, p.wanted(control)); });
  }
  if (moment.until() > kRounding) return std::min(most, moment.until());
  if (can_change_style()) {
    set_style(style);
    enter_best_class(wanted(control));
  }
  return most;
}

}  // namespace fragmotion

// SPDX-License-Identifier: MIT
#include "runtime/player.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "base/ranges.hpp"
#include "base/rates.hpp"
#include "base/rounding.hpp"
#include "base/simd.hpp"
#include "feet/ground_follower.hpp"
#include "feet/look_ahead.hpp"

namespace fragmotion {

void Player::prefetch() const {
  fragmotion::prefetch(this, 1);
  playback_.prefetch();
  correction_.prefetch();
  if (reaching_ != nullptr) reaching_->prefetch();
}

void Player::check_step(const Control& control, double seconds) {
  for (const double value : {control.x, control.y, control.turn, control.jump}) {
    if (!std::isfinite(value)) throw std::invalid_argument("the control holds what is not a number");
    if (std::abs(value) > kMostControl) throw std::invalid_argument("the control holds a number beyond a million");
  }
  if (!(seconds >= 0 && seconds <= kLongestCall)) throw std::invalid_argument("a step must last 0 s to an hour");
}

void Player::reset(const CharacterFrame& frame, int style) {
  check_style(*character_, style);
  for (const double value : {frame.position.x(), frame.position.y(), frame.heading})
    require_range("the place and the heading to stand at", value, -kFarthestPlace, kFarthestPlace);
  governor_.reset(frame.heading);
  if (extras_ != nullptr) {
    set_style(style);
    extras_->whole_body.reset();
    extras_->upper_body.reset();
  }
  director_.reset();
  selector_.reset();
  correction_.reset();
  gaze_.reset();
  if (reaching_ != nullptr) reaching_->reset();
  if (follower_ != nullptr) follower_->reset();
  fragment_ = styled_character().classes.representatives[director_.playing_class()];
  playback_.reset(fragment_, frame);
  correct({}, 0);
}

void Player::force(int next_class) {
  if (next_class < 0 || next_class >= styled_character().classes.count) {
    throw std::invalid_argument("class " + std::to_string(next_class) + " does not exist");
  }
  director_.force(next_class);
}

// Goes on in the take that plays, or plays a fragment of the class that is decided on.
void Player::go_on(const Control& control) {
  const Control wanted = director_.wanted(control);
  fragment_ = director_.continuation(control, playback_, selector_);
  if (fragment_ >= 0) {
    director_.resume(selector_.class_of(fragment_), control);
  } else {
    const int next = director_.decide(control, playback_, selector_);
    fragment_ =
        director_.plays_forced() ? selector_.choose_any(next) : selector_.choose(next, wanted, playback_, !far_away_);
  }
  play(fragment_);
}

void Player::play(int fragment) { keep(playback_.start(fragment)); }

void Player::keep(const Vector2& faster) {
  governor_.keep(faster, playback_);
  ++entered_;
}

Vector2 Player::commanded_velocity() const {
  if (playing_moves()[0] < 0 && !playback_.is_in_the_air()) return governor_.commanded(frame().heading);
  return governor_.pace() * playback_.mean_travel().velocity + governor_.velocity();
}

void Player::correct(const Control& control, double seconds) {
  correction_.correct(playback_, governor_, follower_ == nullptr || follower_->is_even(), seconds);
  if (follower_ != nullptr) follower_->apply(workspace_->shown, feet_ahead(), seconds);
  root_ = workspace_->shown.root;
  if (!gaze_.rests())
    gaze_.apply(governor_.command(control, frame().heading, seconds), styled_character().space.turn_rate(), seconds);
  if (reaching_ != nullptr) reaching_->apply(ground_level(), seconds);
}

FeetAhead Player::feet_ahead() const {
  const Contacts& contacts = playback_.contacts();
  if (contacts.feet[0].empty()) return {};
  Course course{playback_.frame(), governor_.velocity(), governor_.turn_rate(), correction_.steps(), {}, {}, {}};
  for (int side = 0; side < 2; ++side) {
    course.stands[side] = correction_.plants(side, contacts.stands(side, playback_.frame_of_clip()));
    course.until_standing[side] = playback_.until_standing(side) / governor_.pace();
  }
  course.sample = [this](double seconds, WorldPose& pose) {
    playback_.sample_body(playback_.seconds() + governor_.pace() * seconds, pose);
  };
  return look_ahead(*workspace_->body, workspace_->floors, correction_.foot_lock(), course, workspace_->shown,
                    workspace_->poses[0]);
}

void Player::look(Look look, const Vector3& place) {
  for (const double value : place)
    require_range("a place to look at", value, -10 * kFarthestPlace, 10 * kFarthestPlace);
  gaze_.look(look, place);
}

void Player::reach(int hand, const HandAim& aim) {
  if (hand < 0 || hand > 1) throw std::invalid_argument("hand " + std::to_string(hand) + " does not exist");
  require_range("the weight of a hand", aim.weight, 0, 1);
  for (const double value : aim.place)
    require_range("a place to reach for", value, -10 * kFarthestPlace, 10 * kFarthestPlace);
  reaching_->reach(hand, aim);
}

void Player::stand_on(Ground ground) {
  follower_ = ground ? std::make_shared<GroundFollower>(workspace_->body, std::move(ground)) : nullptr;
}

void Player::forget_ground() {
  if (follower_ != nullptr) follower_->forget_ground();
}

double Player::ground_level() const { return follower_ != nullptr ? follower_->level() : 0; }

double Player::ground_missed() const { return follower_ != nullptr ? follower_->missed() : 0; }

double Player::quality(int control) const {
  if (control < 0 || control >= styled_character().space.size()) {
    throw std::invalid_argument("control " + std::to_string(control) + " does not exist");
  }
  return styled_character().quality(director_.previous_class(), director_.playing_class(), control);
}

std::array<std::optional<Vector3>, 2> Player::standing_feet() const {
  const Kinematics& kinematics = workspace_->kinematics;
  const std::array<LegRoles, kMostLegs> legs = leg_roles(kinematics.skeleton().roles);
  const std::array<bool, 2>& stands = playback_.steps().stands;
  PosedBones posed(kinematics.bones());
  kinematics.world(root_, rotations().data(), posed.heads.data(), posed.rotations.data());
  std::array<std::optional<Vector3>, 2> soles;
  for (int side = 0; side < 2; ++side) {
    if (stands[side] && legs[side].foot >= 0) soles[side] = sole(kinematics.skeleton(), legs[side], posed);
  }
  return soles;
}

void Player::step(const Control& given, double seconds) {
  check_step(given, seconds);
  forget_markers();
  const Control control = styled_character().admitted(given);
  director_.observe(control);
  if (seconds == 0) playback_.show();
  for (double rest = seconds; rest > kRounding * seconds;) {
    rest -= advance(control, far_away_ ? rest : std::min(rest, kGameStep));
    const bool is_seen = rest <= kRounding * seconds || extras_ != nullptr;  // what begins over a pose looks at it
    if (is_seen) {
      playback_.show();
    } else {
      playback_.find_frame();
    }
  }
  if (extras_ != nullptr) extras_->upper_body.lay(workspace_->shown);
  correct(control, seconds);
}

// Plays on for a while, which it returns.
double Player::advance(const Control& control, double most) {
  if (extras_ != nullptr) most = begin_style(control, begin_moves(control, most));
  const double part = continue_move(control) ? advance_by_move(most) : advance_by_policy(control, most);
  if (extras_ != nullptr) {
    for (MoveTrack* track : {&extras_->whole_body, &extras_->upper_body.track}) track->moment.wait(part);
    extras_->style.moment.wait(part);
    extras_->upper_body.advance(part);
  }
  return part;
}

double Player::advance_by_policy(const Control& control, double most) {
  governor_.face(frame().heading);
  const Control soon = governor_.command(control, frame().heading, most + kSoon);
  const bool changes = !(soon.x == control.x && soon.y == control.y) && !playback_.is_in_the_air();
  if (director_.is_due(soon, changes, playback_, selector_)) go_on(soon);
  const double pace = governor_.pace(), played = director_.until_due(playback_, most * pace), part = played / pace;
  playback_.advance(played);
  governor_.steer(control, part, playback_);
  return part;
}

}  // namespace fragmotion

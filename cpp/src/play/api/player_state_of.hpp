// SPDX-License-Identifier: MIT
#pragma once

#include "api/player_state.hpp"

namespace fragmotion {

// What numbers of a state may be at most, so that what is played from it are numbers: places and heights in m, headings
// in rad, speeds in m/s, times in s, angles and shares. Beyond them nothing that is sound ever gets.
constexpr double kMostPlace = 1e13, kMostSpeed = 1e9, kMostTime = 1e5, kMostSteepness = 1e6, kMostCount = 2147483647;

template <typename Archive>
void PlayerState::vector(Archive& a, Vector2& v, double most) {
  for (int i = 0; i < 2; ++i) a.number(v[i], -most, most);
}

template <typename Archive>
void PlayerState::vector(Archive& a, Vector3& v, double most) {
  for (int i = 0; i < 3; ++i) a.number(v[i], -most, most);
}

template <typename Archive>
void PlayerState::frame(Archive& a, CharacterFrame& frame) {
  vector(a, frame.position, kMostPlace);
  a.number(frame.heading, -kMostPlace, kMostPlace);
}

template <typename Archive>
void PlayerState::control(Archive& a, Control& control) {
  for (double* value : {&control.x, &control.y, &control.turn, &control.jump})
    a.number(*value, -kMostControl, kMostControl);
}

template <typename Archive>
void PlayerState::approach(Archive& a, Approach& approach) {
  a.number(approach.value, -kMostPlace, kMostPlace);
  a.number(approach.speed, -kMostPlace, kMostPlace);
}

template <typename Archive>
void PlayerState::footing(Archive& a, Footing& footing) {
  vector(a, footing.place, kMostPlace);
  a.number(footing.height, -kMostPlace, kMostPlace);
  vector(a, footing.slope, kMostSteepness);
}

template <typename Archive>
void PlayerState::exchange(Archive& a, CommandLimit& limit) {
  vector(a, limit.velocity_, kMostSpeed);
  a.number(limit.heading_, -kMostPlace, kMostPlace);
}

template <typename Archive>
void PlayerState::exchange(Archive& a, Director& director, const Character& style) {
  const int last = style.classes.count - 1;
  a.number(director.class_, 0, last);
  a.number(director.previous_, 0, last);
  a.number(director.waiting_, -1, last);
  a.number(director.forced_, -1, last);
  a.number(director.plays_forced_, 0, 1);
  a.number(director.soonest_, 0, kMostTime);
  control(a, director.decided_for_);
  control(a, director.planned_for_);
  a.number(director.exit_.next_class, -1, last);
  a.number(director.exit_.seconds, -kMostTime, kMostTime);
  a.number(director.exit_.cost, -kMostPlace, kMostPlace);
  a.number(director.jump_pressed_, 0, 1);
  a.number(director.jump_latched_, 0, 1);
}

template <typename Archive>
void PlayerState::exchange(Archive& a, FragmentSelector& selector) {
  a.bits(selector.seed_);
  a.bits(selector.random_);
}

template <typename Archive>
void PlayerState::exchange(Archive& a, Inertialization& inertialization) {
  a.number(inertialization.damping_, 0, 1e15);
  a.number(inertialization.end_, 0, kMostTime);
  vector(a, inertialization.root_, kMostPlace);
  vector(a, inertialization.root_speed_, kMostSpeed);
  a.number(inertialization.heading_, -kMostPlace, kMostPlace);
  a.number(inertialization.heading_speed_, -kMostSpeed, kMostSpeed);
  a.floats(inertialization.offsets_.data(), std::size_t{6} * inertialization.bones());
}

template <typename Archive>
void PlayerState::placed(Archive& a, Playback::Placed& placed, const Numbers& may_be) {
  a.number(placed.style, may_be.style, may_be.style);
  a.number(placed.number, may_be.first, may_be.last);
  a.number(placed.seconds, -kMostTime, kMostTime);
  a.number(placed.heading, -kMostPlace, kMostPlace);
  vector(a, placed.offset, kMostPlace);
}

// `now`: what it may play; before that it played anything of a style.
template <typename Archive>
void PlayerState::exchange(Archive& a, Playback& playback, int of_style, const Numbers& now) {
  const Character& character = *playback.character_;
  a.number(playback.style_, of_style, of_style);
  placed(a, playback.now_, now);
  const int style = a.told(playback.before_.style, 0, character.style_count() - 1);
  placed(a, playback.before_, all_of(character, style));
  control(a, playback.evident_of_hips_);
  vector(a, playback.beside_ends_, kMostSpeed);
  for (double* time : {&playback.faded_, &playback.stitched_}) a.number(*time, 0, kMostTime);
  for (bool& stands : playback.steps_.stands) a.number(stands, 0, 1);
  a.number(playback.steps_.last, -1, 1);
  a.number(playback.steps_.since, 0, kMostPlace);
  exchange(a, playback.inertialization_);
  a.number(playback.look_.damping_, 0, 1e15);
  a.number(playback.turning_, -kMostSpeed, kMostSpeed);
  frame(a, playback.frame_);
  if constexpr (Archive::kKeeps) playback.facing_ = PlaneTurn(playback.frame_.heading);
}

template <typename Archive>
void PlayerState::exchange(Archive& a, FootLock& lock) {
  for (FootLock::Foot& foot : lock.feet_) {
    a.number(foot.locked, 0, 1);
    a.number(foot.steps, 0, 1);
    for (Vector2* place : {&foot.moved, &foot.shown, &foot.held}) vector(a, *place, kMostPlace);
    for (Vector2* speed : {&foot.speed, &foot.drift}) vector(a, *speed, kMostPlace);
    a.number(foot.height, -kMostPlace, kMostPlace);
    a.number(foot.holds, 0, 1);
    a.number(foot.free, 0, kMostPlace);
    a.number(foot.lowered, -kMostPlace, kMostPlace);
    a.number(foot.raised, -kPi, kPi);
    for (double* angle : {&foot.faces, &foot.turn}) a.number(*angle, -kPi, kPi);
    a.number(foot.turn_speed, -kMostSpeed, kMostSpeed);
    a.number(foot.stood, 0, kMostPlace);
  }
  a.number(lock.fresh_, 0, 1);
  a.number(lock.stood_, 0, kMostPlace);
  a.number(lock.sunk_, -kMostPlace, kMostPlace);
}

template <typename Archive>
void PlayerState::exchange(Archive& a, RootGovernor& governor) {
  exchange(a, governor.limit_);
  vector(a, governor.acceleration_, kMostSpeed);
  vector(a, governor.velocity_, kMostSpeed);
  vector(a, governor.played_, kMostSpeed);
  a.number(governor.begins_, 0, 1);
  a.number(governor.turn_rate_, -kMostSpeed, kMostSpeed);
  a.number(governor.tempo_, 0.01, 2);  // the square root of a slow walk's speed over a run's, and no quotient by 0
  a.number(governor.quicker_, 0.01, 10);
  a.number(governor.ahead_, -kMostTime, kMostTime);
  a.number(governor.target_heading_, -kMostPlace, kMostPlace);
}

template <typename Archive>
void PlayerState::exchange(Archive& a, PoseCorrection& correction) {
  for (int i = 0; i < 4; ++i) a.number(correction.steps_.stride(i / 2, i % 2), -kMostSpeed, kMostSpeed);
  vector(a, correction.steps_.shift, kMostPlace);
  exchange(a, correction.foot_lock_);
  vector(a, correction.lean_.pushed_, kMostSpeed);
  vector(a, correction.lean_.acceleration_, kMostSpeed);
}

template <typename Archive>
void PlayerState::exchange(Archive& a, Gaze& gaze) {
  const int look = a.told(static_cast<int>(gaze.look_), 0, static_cast<int>(Look::at));
  if constexpr (Archive::kKeeps) gaze.look_ = static_cast<Look>(look);
  vector(a, gaze.place_, kMostPlace);
  for (bool* flag : {&gaze.turned_, &gaze.wants_, &gaze.begins_}) a.number(*flag, 0, 1);
  vector(a, gaze.wanted_, 2 * kPi);
  for (double& part : gaze.head_.coeffs()) a.number(part, -1.001, 1.001);
  for (Approach& offset : gaze.offset_) approach(a, offset);
  a.number(gaze.due_, 0, kMostTime);
}

template <typename Archive>
void PlayerState::exchange(Archive& a, Reaching& reaching) {
  for (Reaching::Hand& hand : reaching.hands_) {
    vector(a, hand.aim.place, kMostPlace);
    a.number(hand.aim.weight, 0, 1);
    a.number(hand.aim.carried, 0, 1);
    for (Approach& place : hand.place) approach(a, place);
    approach(a, hand.weight);
    for (double* due : {&hand.place_due, &hand.weight_due}) a.number(*due, 0, kMostPlace);
    a.number(hand.since, 0, kMostPlace);
    for (Reaching::Turn& turn : hand.turns) {
      for (double& part : turn.wanted.coeffs()) a.number(part, -1.001, 1.001);
      for (Approach& offset : turn.offset) approach(a, offset);
      a.number(turn.due, 0, kMostPlace);
    }
  }
  vector(a, reaching.lean_, kPi);
  frame(a, reaching.frame_);
  a.number(reaching.level_, -kMostPlace, kMostPlace);
  vector(a, reaching.speed_, kMostPlace);
  a.number(reaching.turning_, -kMostPlace, kMostPlace);
  reaching.idles_ = false;
}

template <typename Archive>
void PlayerState::exchange(Archive& a, Moment& moment) {
  a.number(moment.begins_in_, 0, kMostTime);
  a.number(moment.patience_, 0, kLongestWait);
  a.number(moment.planned_, 0, 1);
  control(a, moment.planned_for_);
}

// Returns the move that plays.
template <typename Archive>
int PlayerState::exchange(Archive& a, MoveTrack& track, bool upper_body) {
  const std::vector<Move>& moves = track.character_->moves;
  std::array<int, 2> found{track.playing_, track.waiting_};
  for (int& move : found) {
    move = a.told(move, -1, static_cast<double>(moves.size()) - 1);
    demand(move < 0 || moves[move].upper_body == upper_body, FRAGMOTION_ERROR_REFUSED,
           "the state holds a move where it cannot be");
  }
  if constexpr (Archive::kKeeps) {
    track.playing_ = found[0];
    track.waiting_ = found[1];
  }
  a.number(track.held_, 0, 1);
  a.number(track.waiting_is_held_, 0, 1);
  const int part = a.told(static_cast<int>(track.part_), 0, kMoveParts - 1);
  if constexpr (Archive::kKeeps) track.part_ = static_cast<MovePart>(part);
  exchange(a, track.moment);
  return found[0];
}

// Returns the move of the whole body that plays.
template <typename Archive>
int PlayerState::exchange(Archive& a, Player::Extras& extras) {
  const int whole = exchange(a, extras.whole_body, false);
  UpperBody& upper = extras.upper_body;
  const Character& character = *upper.character_;
  const int move = exchange(a, upper.track, true);
  exchange(a, upper.playback_, 0, move < 0 ? all_of(character, 0) : parts_of(character, move));
  a.number(upper.weight_, 0, upper.base_ < 0 ? 0 : 1);
  a.number(extras.style.waiting, -1, character.style_count() - 1);
  exchange(a, extras.style.moment);
  return whole;
}

template <typename Archive>
void PlayerState::exchange(Archive& a, KnownGround& ground) {
  a.number(ground.count_, 0, KnownGround::kMost);
  a.number(ground.next_, 0, KnownGround::kMost - 1);
  for (KnownGround::Known& known : ground.known_) {
    footing(a, known.plane);
    a.number(known.exists, 0, 1);
  }
}

template <typename Archive>
void PlayerState::exchange(Archive& a, FootOnGround& foot) {
  a.number(foot.fresh_, 0, 1);
  a.number(foot.stood_, 0, 1);
  a.number(foot.found_, 0, 1);
  for (Footing* plane : {&foot.last_, &foot.next_, &foot.plane_}) footing(a, *plane);
  approach(a, foot.error_);
  exchange(a, foot.known_);
  vector(a, foot.beside_, kMostPlace);
  for (Approach& shift : foot.shift_) approach(a, shift);
  approach(a, foot.clearance_);
  a.number(foot.swing_time_, 0, kMostPlace);
  a.number(foot.due_, 0, kMostPlace);
  a.number(foot.lift_, -kMostPlace, kMostPlace);
  a.number(foot.weight_, 0, 1);
}

template <typename Archive>
void PlayerState::exchange(Archive& a, HipsOnGround& hips) {
  a.number(hips.fresh_, 0, 1);
  vector(a, hips.place_, kMostPlace);
  a.number(hips.level_, -kMostPlace, kMostPlace);
  a.number(hips.speed_, -kMostPlace, kMostPlace);
  approach(a, hips.sunk_);
}

template <typename Archive>
void PlayerState::exchange(Archive& a, GroundFollower& follower) {
  for (FootOnGround& foot : follower.feet_) exchange(a, foot);
  exchange(a, follower.hips_);
  a.number(follower.fresh_, 0, 1);
  a.number(follower.exact_, 0, 1);
  a.number(follower.level_, -kMostPlace, kMostPlace);
  a.number(follower.missed_, 0, kMostPlace);
}

template <typename Archive>
void PlayerState::exchange(Archive& a, Player& player) {
  const Character& character = *player.character_;
  const int style = a.told(player.playing_style(), 0, character.style_count() - 1);
  if constexpr (Archive::kKeeps) {
    if (player.extras_ != nullptr) player.set_style(style);
  }
  const Character& in_style = character.in_style(style);
  exchange(a, player.director_, in_style);
  exchange(a, player.selector_);
  const int move = player.extras_ == nullptr ? -1 : exchange(a, *player.extras_);
  const int fragments = static_cast<int>(in_style.pool.fragments.size());
  exchange(a, player.playback_, style, move < 0 ? Numbers{style, 0, fragments - 1} : parts_of(character, move));
  exchange(a, player.governor_);
  exchange(a, player.correction_);
  exchange(a, player.gaze_);
  if (player.reaching_ != nullptr) exchange(a, *player.reaching_);
  a.number(player.entered_, 0, kMostCount);
  a.number(player.fragment_, 0, fragments - 1);
  vector(a, player.root_, kMostPlace);
  const bool stands = player.follower_ != nullptr;
  demand(a.told(stands, 0, 1) == stands, FRAGMOTION_ERROR_REFUSED,
         stands ? "the state is of a player without a ground, and this one has one"
                : "the state is of a player that has a ground, and this one has none");
  if (stands) exchange(a, *player.follower_);
}

template <typename Archive>
void PlayerState::exchange(Archive& a, PathFollower& follower) {
  a.number(follower.way_, -kMostPlace, kMostPlace);
  a.number(follower.seconds_, 0, kMostPlace);
  a.number(follower.speed_, 0, kMostSpeed);
  vector(a, follower.velocity_, kMostSpeed);
  frame(a, follower.before_);
  for (bool* flag : {&follower.observed_, &follower.approaches_, &follower.set_off_, &follower.stands_})
    a.number(*flag, 0, 1);
}

template <typename Archive>
void PlayerState::exchange(Archive& a, Steering& steering) {
  a.number(steering.side_, -1, 1);
}

template <typename Archive>
void PlayerState::exchange(Archive& a, WayRound& way_round) {
  vector(a, way_round.wanted_, kMostSpeed);
  a.number(way_round.held_up_, 0, WayRound::kPatience);
}

}  // namespace fragmotion

// SPDX-License-Identifier: MIT
#include <algorithm>
#include <stdexcept>

#include "base/rounding.hpp"
#include "runtime/plan_moment.hpp"

namespace fragmotion {

void Player::make_extras(const PlayerOptions& options) {
  if (character_->moves.empty() && character_->style_count() == 1) return;
  extras_ = std::make_shared<Extras>(
      Extras{MoveTrack(*character_),
             UpperBody(*character_, *workspace_, options.stitching, options.stitch),
             std::shared_ptr<Player>(new Player(character_, options, workspace_)),
             static_cast<int>(&character_->policy(options.policy) - character_->policies.data()),
             {}});
}

void Player::play_move(int part) {
  keep(playback_.start_move(part));
  playback_.show();  // what the upper body's next move is measured from
}

MoveTrack& Player::track_of(int move) {
  if (move < 0 || move >= static_cast<int>(character_->moves.size())) {
    throw std::invalid_argument("move " + std::to_string(move) + " does not exist; the character has " +
                                std::to_string(character_->moves.size()));
  }
  return character_->moves[move].upper_body ? extras_->upper_body.track : extras_->whole_body;
}

void Player::start_move(int move) { track_of(move).press(move); }

void Player::release_move(int move) { track_of(move).release(move); }

std::array<int, 2> Player::playing_moves() const {
  if (extras_ == nullptr) return {-1, -1};
  return {extras_->whole_body.playing(), extras_->upper_body.track.playing()};
}

std::array<int, 2> Player::waiting_moves() const {
  if (extras_ == nullptr) return {-1, -1};
  return {extras_->whole_body.waiting(), extras_->upper_body.track.waiting()};
}

std::array<PassedMarkers, 2> Player::passed_markers() const {
  return {playback_.passed(), extras_ != nullptr ? extras_->upper_body.passed_markers() : PassedMarkers()};
}

void Player::forget_markers() {
  playback_.forget_markers();
  if (extras_ != nullptr) extras_->upper_body.forget_markers();
}

// Is where another player is, which has no moves that play or wait.
void Player::imitate(const Player& other) {
  governor_ = other.governor_;
  director_ = other.director_;
  selector_ = other.selector_;
  playback_ = other.playback_;
  correction_ = other.correction_;
  far_away_ = other.far_away_;
}

bool Player::is_stitched() const { return playback_.seconds() > playback_.faded() - kRounding; }

bool Player::can_begin_move() const { return !playback_.is_jumping() && is_stitched(); }

// Whether the moment has come for the move that waits in a track.
template <typename Cost>
bool Player::is_due(MoveTrack& track, const Control& control, const Cost& cost) {
  if (!track.waits() || track.plays()) return false;
  Moment& moment = track.moment;
  if (moment.needs_plan(control, character_->space)) {
    if (extras_->whole_body.plays()) {
      moment.plan(0, control);  // what goes over another begins at once
    } else {
      plan(moment, control, &Player::can_begin_move, cost);
    }
  }
  return moment.until() < kRounding && can_begin_move();
}

// Begins what is due. Returns until when no other moment comes, at most `most` s.
double Player::begin_moves(const Control& control, double most) {
  MoveTrack& whole = extras_->whole_body;
  UpperBody& upper = extras_->upper_body;
  if (is_due(whole, control, [&](const Player& p) { return p.selector_.distance_to(whole.waiting(), p.playback_); })) {
    play_move(whole.begin());
  }
  if (is_due(upper.track, control, [&](const Player&) { return upper.distance_to(upper.track.waiting()); })) {
    upper.begin();
  }
  for (const MoveTrack* track : {&whole, &upper.track}) {
    if (track->waits() && track->moment.until() > kRounding) most = std::min(most, track->moment.until());
  }
  return most;
}

// Whether a whole-body move plays on. At the end of one what follows is begun.
bool Player::continue_move(const Control& control) {
  if (extras_ == nullptr || !extras_->whole_body.plays()) return false;
  MoveTrack& track = extras_->whole_body;
  if (playback_.left() > kRounding) return true;
  const int part = track.next_part();
  if (part >= 0) {
    play_move(part);
  } else if (track.waits()) {
    play_move(track.begin());
  } else {
    resume(control);
  }
  return track.plays();
}

double Player::advance_by_move(double most) {
  const double part = std::min(most, playback_.left());
  playback_.advance(part);
  governor_.leave(part, playback_);
  return part;
}

// Goes back into the policy where it joins best for the control of a moment later: a body that stands is asked for
// nothing in the first.
void Player::resume(const Control& control) {
  const double heading = frame().heading;
  if (waiting_style() >= 0) set_style(waiting_style());
  governor_.resume(heading, playback_.velocity());
  enter_best_class(director_.wanted(governor_.command(control, heading, kSoon)));
}

void Player::enter_best_class(const Control& wanted) {
  const int next = selector_.best_class(wanted, playback_);
  director_.resume(next, wanted);
  fragment_ = selector_.choose(next, wanted, playback_);
  play(fragment_);
}

}  // namespace fragmotion

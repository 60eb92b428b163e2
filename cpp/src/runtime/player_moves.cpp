// SPDX-License-Identifier: MIT
#include <algorithm>
#include <limits>
#include <stdexcept>

#include "fragmotion/fragments/body_tips.hpp"
#include "fragmotion/runtime/player.hpp"

namespace fragmotion {
namespace {

constexpr double kInstant = 1e-9;                // s: no time
constexpr double kLook = 0.05;                   // s between the moments at which a move may begin
constexpr double kImpatience = 1 / kTunedReach;  // m a metre of reach that a second of waiting costs
constexpr double kAhead = 0.25;                  // s by which the command at a move's end is that of later

}  // namespace

void Player::make_moves(const PlayerOptions& options) {
  if (character_->moves.empty()) return;
  moves_ = std::make_shared<Moves>(Moves{MoveTrack(*character_),
                                         UpperBody(*character_, *workspace_, options.stitching, options.stitch),
                                         std::shared_ptr<Player>(new Player(character_, options, workspace_))});
}

MoveTrack& Player::track_of(int move) {
  if (move < 0 || move >= static_cast<int>(character_->moves.size())) {
    throw std::invalid_argument("move " + std::to_string(move) + " does not exist; the character has " +
                                std::to_string(character_->moves.size()));
  }
  return character_->moves[move].upper_body ? moves_->upper_body.track : moves_->whole_body;
}

void Player::start_move(int move) { track_of(move).press(move); }

void Player::release_move(int move) { track_of(move).release(move); }

std::array<int, 2> Player::playing_moves() const {
  if (moves_ == nullptr) return {-1, -1};
  return {moves_->whole_body.playing(), moves_->upper_body.track.playing()};
}

std::array<int, 2> Player::waiting_moves() const {
  if (moves_ == nullptr) return {-1, -1};
  return {moves_->whole_body.waiting(), moves_->upper_body.track.waiting()};
}

// Is where another player is, which has no moves that play or wait.
void Player::imitate(const Player& other) {
  limit_ = other.limit_;
  director_ = other.director_;
  selector_ = other.selector_;
  playback_ = other.playback_;
  correction_ = other.correction_;
}

bool Player::can_begin_move() const {
  return !playback_.is_jumping() && playback_.seconds() > playback_.faded() - kInstant;
}

// Finds the moment for the move that waits: at which `cost` of what would be shown is least.
template <typename Cost>
void Player::plan(MoveTrack& track, const Control& control, const Cost& cost) {
  if (moves_->whole_body.plays()) return track.plan(0, control);  // what goes over another begins at once
  Player& ahead = *moves_->rehearsal;
  ahead.imitate(*this);
  ahead.playback_.show();
  double best = track.patience(), least = std::numeric_limits<double>::infinity();
  for (double wait = 0;;) {
    const double total = cost(ahead) + kImpatience * wait;
    if (ahead.can_begin_move() && total < least) least = total, best = wait;
    const double next = std::min(wait + kLook, track.patience());
    if (next - wait < kInstant) break;
    for (double rest = next - wait; rest > kInstant;) rest -= ahead.advance(control, std::min(rest, kFinest));
    wait = next;
  }
  track.plan(best, control);
}

// Whether the moment has come for the move that waits in a track.
template <typename Cost>
bool Player::is_due(MoveTrack& track, const Control& control, const Cost& cost) {
  if (!track.waits() || track.plays()) return false;
  if (track.needs_plan(control)) plan(track, control, cost);
  return track.until_begin() < kInstant && can_begin_move();
}

// Begins what is due. Returns until when no other moment comes, at most `most` s.
double Player::begin_moves(const Control& control, double most) {
  MoveTrack& whole = moves_->whole_body;
  UpperBody& upper = moves_->upper_body;
  if (is_due(whole, control, [&](const Player& p) { return p.selector_.distance_to(whole.waiting(), p.playback_); })) {
    play(whole.begin());
  }
  if (is_due(upper.track, control, [&](const Player&) { return upper.distance_to(upper.track.waiting()); })) {
    upper.begin();
  }
  for (const MoveTrack* track : {&whole, &upper.track}) {
    if (track->waits() && track->until_begin() > kInstant) most = std::min(most, track->until_begin());
  }
  return most;
}

// Whether a whole-body move plays on. At the end of one what follows is begun.
bool Player::continue_move(const Control& control) {
  if (moves_ == nullptr || !moves_->whole_body.plays()) return false;
  MoveTrack& track = moves_->whole_body;
  if (playback_.left() > kInstant) return true;
  const int part = track.next_part();
  if (part >= 0) {
    play(part);
  } else if (track.waits()) {
    play(track.begin());
  } else {
    resume(control);
  }
  return track.plays();
}

double Player::advance_by_move(double most) {
  const double part = std::min(most, playback_.left());
  acceleration_ = Vector2::Zero();
  playback_.advance(part);
  correction_.leave_root(part, playback_);
  return part;
}

// Goes back into the policy where it joins best for the control of a moment later: a body that stands is asked for
// nothing in the first.
void Player::resume(const Control& control) {
  const double heading = frame().heading;
  limit_.reset(heading, playback_.velocity());
  const Control wanted = director_.wanted(limit_.after(control, heading, kAhead));
  const int next = selector_.best_class(wanted, playback_);
  director_.resume(next, wanted);
  fragment_ = selector_.choose(next, wanted, playback_);
  play(fragment_);
}

}  // namespace fragmotion

// SPDX-License-Identifier: MIT
#include "runtime/move_track.hpp"

#include <utility>

namespace fragmotion {

void MoveTrack::press(int move) {
  waiting_ = move;
  waiting_is_held_ = true;
  moment.await(character_->moves[move].wait);
}

void MoveTrack::release(int move) {
  if (move == waiting_) {
    waiting_is_held_ = false;
  } else if (move == playing_) {
    held_ = false;
  }
}

int MoveTrack::begin() {
  playing_ = std::exchange(waiting_, -1);
  held_ = waiting_is_held_;
  part_ = MovePart::opening;
  return character_->number_of(playing_, part_);
}

bool MoveTrack::repeats() const {
  return plays() && part_ != MovePart::closing && character_->moves[playing_].loops() && held_ && !waits();
}

int MoveTrack::next_part() {
  const bool was_closing = part_ == MovePart::closing;
  part_ = repeats() ? MovePart::loop : MovePart::closing;
  const int number = character_->number_of(playing_, part_);
  const Fragment& next = character_->played(number);
  if (!was_closing && next.end > next.begin) return number;
  playing_ = -1;
  return -1;
}

}  // namespace fragmotion

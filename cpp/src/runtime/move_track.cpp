// SPDX-License-Identifier: MIT
#include "fragmotion/runtime/move_track.hpp"

#include <algorithm>
#include <utility>

namespace fragmotion {
namespace {

constexpr double kOtherwise = 0.5;  // ControlDis to the control that was planned for that makes a plan void

}  // namespace

void MoveTrack::press(int move) {
  waiting_ = move;
  waiting_is_held_ = true;
  planned_ = false;
  patience_ = character_->moves[move].wait;
}

void MoveTrack::release(int move) {
  if (move == waiting_) {
    waiting_is_held_ = false;
  } else if (move == playing_) {
    held_ = false;
  }
}

bool MoveTrack::needs_plan(const Control& control) const {
  return !planned_ || (begins_in_ > 0 && character_->space.distance(control, planned_for_) > kOtherwise);
}

void MoveTrack::plan(double seconds, const Control& control) {
  begins_in_ = seconds;
  planned_for_ = control;
  planned_ = true;
}

void MoveTrack::wait(double seconds) {
  begins_in_ = std::max(0.0, begins_in_ - seconds);
  patience_ = std::max(0.0, patience_ - seconds);
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

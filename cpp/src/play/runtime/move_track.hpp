// SPDX-License-Identifier: MIT
#pragma once

#include "character/character.hpp"
#include "runtime/moment.hpp"

namespace fragmotion {

/// One move at a time: which waits, when it begins, and which of its parts comes next. A move that is pressed while
/// another plays follows it; a loop is left for it.
class MoveTrack {
 public:
  /// The character must outlive it.
  explicit MoveTrack(const Character& character) : character_(&character) {}

  /// No move plays or waits.
  void reset() { *this = MoveTrack(*character_); }
  /// Lets a move wait for its moment, in place of one that waits.
  void press(int move);
  /// It is not held any more, and is played to its end.
  void release(int move);

  /// -1: none.
  int playing() const { return playing_; }
  int waiting() const { return waiting_; }
  bool plays() const { return playing_ >= 0; }
  bool waits() const { return waiting_ >= 0; }

  /// Whether the loop follows what plays.
  bool repeats() const;
  /// Begins the waiting move. Returns the number of its first part.
  int begin();
  /// The number of the part that follows the one that has ended; -1 where the move is over, and plays no more.
  int next_part();

  Moment moment;  ///< Of the move that waits.

 private:
  friend struct PlayerState;

  const Character* character_;
  int playing_ = -1, waiting_ = -1;
  bool held_ = false, waiting_is_held_ = false;
  MovePart part_ = MovePart::opening;
};

}  // namespace fragmotion

// SPDX-License-Identifier: MIT
#pragma once

#include "character/character.hpp"

namespace fragmotion {

/// A move as it is given to a character, and had back from it.
struct MoveClip {
  std::string name;
  Clip clip;
  bool upper_body = false;
  double wait = 0.5;             ///< s, 0 .. kLongestWait
  std::array<double, 2> loop{};  ///< s from the clip's beginning; twice the same: none
};

/// The character with these moves in place of those that it has; all else stays as it is. The clips need not have been
/// through make_clip, and are refused as by it. Throws std::invalid_argument that begins with the move's name also on
/// one that is of another skeleton, shorter or longer than moves are (move.hpp), or of the upper body of a skeleton
/// that has none; on two of one name, on one without, and on more than kMostMoves.
Character with_moves(const Character& character, const std::vector<MoveClip>& moves);

/// The moves of a character, as with_moves() takes them.
std::vector<MoveClip> moves_of(const Character& character);

}  // namespace fragmotion

// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <string>
#include <vector>

#include "fragments/fragment.hpp"

namespace fragmotion {

/// What moves may be: s that they last, s that they wait for their moment, s that a loop lasts; and how many there are.
constexpr double kShortestMove = 0.1, kLongestMove = 60, kLongestWait = 2, kShortestLoop = 0.1;
constexpr int kMostMoves = 256;

/// Anything that is not locomotion: wave, punch, sit down. A clip of the pool's from which no fragment is cut.
struct Move {
  std::string name;
  int clip = 0;                      ///< Of the pool's.
  bool upper_body = false;           ///< Only what is above the legs, which go on walking.
  double wait = 0.5;                 ///< s in which it looks for the moment that joins best.
  int loop_begin = 0, loop_end = 0;  ///< Frames of the clip that are played again while it is held; the same: none.

  bool loops() const { return loop_end > loop_begin; }
};

/// What of a move is played without a stitch: to the loop's end, the loop again, and on to the move's end; of one
/// without a loop all is the opening. What has no frames is not played.
enum class MovePart { opening, loop, closing };
constexpr int kMoveParts = 3;

/// The parts of each move, [moves, kMoveParts], as the pool's fragments are played.
std::vector<Fragment> move_parts(const PackedPool& pool, const std::vector<Move>& moves);

/// Throws std::invalid_argument that begins with the move's name unless the times, s, are what a move may have. `loop`:
/// its begin and end, or twice the same.
void check_move_times(const std::string& name, double seconds, double wait, const std::array<double, 2>& loop);

/// A move that was asked for while a trace was played.
struct MovePress {
  int control = 0;  ///< Before which of the trace's controls.
  int move = 0;
  int held = 0;  ///< For so many controls.
};

}  // namespace fragmotion

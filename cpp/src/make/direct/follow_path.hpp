// SPDX-License-Identifier: MIT
#pragma once

#include "base/progress.hpp"
#include "control/trace.hpp"
#include "direct/path_follower.hpp"
#include "runtime/player.hpp"

namespace fragmotion {

/// What a player did along a path.
struct PathWalk {
  Trace trace;                   ///< As from a stick: played from the same start and seed, it shows the same motion.
  double mean_distance = 0;      ///< Of the character frame from the path, m, while it was on it and had not arrived,
  double greatest_distance = 0;  ///< and the greatest.
  /// From the path's end, m: where it stands at last; where it does not stop there, when it arrived or at last.
  double arrival_distance = 0;
  bool arrived = false;        ///< It came to the path's end: where it is to stand, to less than kArrived and slowly.
  double seconds = 0;          ///< When it arrived; where it did not, how long the trace is.
  double planned_seconds = 0;  ///< When it was to: the time that was asked for, or as soon as it can.
  double asked_speed = 0;      ///< m/s, PathFollower::asked_speed
};

/// Lets a player follow a path from `start`, where it is reset to in the style that it plays, a control every
/// 1/kTraceRate s, shown at `rate` frames a second as perform() shows a trace. It lasts a second longer than until it
/// stands at the end, and `seconds` at most. Where it does not stand or arrive just so, it is tried again, with the way
/// to the end begun sooner or later, and the best is taken. Throws std::invalid_argument on a rate that is not over 0
/// and at most 1000, unless `seconds` is 0.1 to 3600, and as Player::reset and PathFollower.
PathWalk follow_path(Player& player, const CharacterFrame& start, const Path& path, const FollowOptions& options,
                     double rate, double seconds, const Progress& progress = {});

}  // namespace fragmotion

// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "evaluate/body_track.hpp"

namespace fragmotion {

/// For how long before the take-off and after the landing it is a jump, s.
constexpr double kAroundJump = 0.5;

/// The heights that a body usually has, m of a 1.8 m character: medians over time.
struct UsualHeights {
  double center = 0, hips = 0;
};

UsualHeights usual_heights(const std::vector<BodyTrack>& tracks);

/// A time in which neither ball nor heel of either foot is within 4.5 cm of its floor, and the centre of mass rises
/// 0.2 m or more over its usual height: a whole jump by Ev (evident.hpp), and more than a bouncy run.
struct Jump {
  int take_off = 0;        ///< The last frame before it.
  int landing = 0;         ///< The first frame after it.
  double dip = 0;          ///< m by which the hips get under their usual height in the half second before the take-off,
  double landing_dip = 0;  ///< and in that after the landing; NaN where the motion is shorter.
  /// The time between take-off and landing over that of a ballistic flight of the centre of mass between its heights
  /// then, through its greatest height: sqrt(2 rise / g) + sqrt(2 fall / g). NaN where that is under 0.05 s.
  double flight_ratio = 0;
};

/// In order; none without feet.
std::vector<Jump> find_jumps(const BodyTrack& track, const UsualHeights& usual);

}  // namespace fragmotion

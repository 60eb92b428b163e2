// SPDX-License-Identifier: MIT
#pragma once

#include "motion/clip.hpp"

namespace fragmotion {

/// s of two steps of a gait; longer only where there is no shorter one of it.
constexpr double kShortestCycle = 0.4, kLongestCycle = 1.4;

/// The frames after which a clip begins again: one less than it has where the last shows the first's pose once more,
/// as many where the first would be the next. 0 where the clip is no cycle: its ends, seen from their character frames,
/// are farther apart than what a thirtieth of a second changes beside them.
int cycle_of(const Kinematics& kinematics, const Clip& clip);

/// Frames 0 .. `count` - 1 of the clip that goes round and round, `period` as of cycle_of(): each round begins where
/// and as the last one ended.
Clip unrolled(const Kinematics& kinematics, const Clip& clip, int period, int count);

/// A clip without the frames at its end in which it hardly moves any more, less than a hundredth of the mean: a file
/// may hold a cycle's last pose for as long as its other clips last.
Clip without_held_end(Clip clip);

}  // namespace fragmotion

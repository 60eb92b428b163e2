// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "motion/clip.hpp"

namespace fragmotion {

/// The frames of a clip that no body gets to from the frame before, in order: the second frame of many files follows a
/// calibration pose, and markers get mixed up. There a bone turns by more than 60 degrees at once, and by so much
/// otherwise than in the frame before and in the one after, as no limb does that is swung fast (a gallop at 24 frames a
/// second), or the hips go faster than 20 m/s (of a character of 1.8 m). Bones that Dis leaves out, as fingers, do not
/// count. None in a closed cycle (cycle_of()): drawn limbs snap from pose to pose, and no captured motion ends where it
/// began.
std::vector<int> discontinuities(const Skeleton& skeleton, const Clip& clip);

/// Lets the hips go on at each of these frames over the place where they were in the frame before: how fast a body goes
/// is told by the frames around, and a place to which it jumped is no way that it went.
void close_way(const std::vector<int>& discontinuities, Clip& clip);

}  // namespace fragmotion

// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "motion/clip.hpp"
#include "skeleton/kinematics.hpp"

namespace fragmotion {

/// How many times as far as its legs stretch and bend the hips go up and down in a clip; 0 where the legs do not
/// explain most of that.
double bobs(const Kinematics& kinematics, const Clip& clip);

/// How many times too far up and down the hips go in these clips: what stands on the ground goes as its legs stretch
/// and bend. 1 where that is not told, by no clip whose legs explain most of what the hips do, or by a clip in which
/// they go less than five times too far: flights go farther than legs, too.
double bobs_too_far(const Kinematics& kinematics, const std::vector<Clip>& clips);

}  // namespace fragmotion

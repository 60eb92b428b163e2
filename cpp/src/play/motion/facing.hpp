// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "motion/clip.hpp"

namespace fragmotion {

/// Where the character faces in each frame, rad, unwrapped: the heading of the hips, smoothed over a gait cycle (local
/// linear regression, Gaussian of 0.25 s), so that the sway of the pelvis is not taken for turning.
std::vector<double> facing(const Kinematics& kinematics, const Clip& clip);

}  // namespace fragmotion

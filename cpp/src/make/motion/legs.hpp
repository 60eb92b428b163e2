// SPDX-License-Identifier: MIT
#pragma once

#include "motion/clip.hpp"
#include "skeleton/two_bone_ik.hpp"

namespace fragmotion {

/// Adds to the hinge of each of some legs the axes about which its knee is bent in a clip, as the thigh sees it, each
/// the longer the more it is bent; every `apart`-th frame is looked at.
void add_bends(const Kinematics& kinematics, const Clip& clip, int apart, Legs& legs);

/// resting_legs() whose knees bend as they do in the clips, as far as they do.
Legs find_legs(const Kinematics& kinematics, const std::vector<Clip>& clips);

}  // namespace fragmotion

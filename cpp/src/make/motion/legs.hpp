// SPDX-License-Identifier: MIT
#pragma once

#include "motion/clip.hpp"
#include "skeleton/two_bone_ik.hpp"

namespace fragmotion {

/// resting_legs() whose knees bend as they do in the clips, as far as they do.
Legs find_legs(const Kinematics& kinematics, const std::vector<Clip>& clips);

}  // namespace fragmotion

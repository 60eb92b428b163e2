// SPDX-License-Identifier: MIT
#pragma once

#include "motion/clip.hpp"
#include "skeleton/two_bone_ik.hpp"

namespace fragmotion {

/// The axis about which a knee is bent in a pose, as the thigh sees it; the longer the more it is bent.
Vector3 bend_axis(const Leg& leg, const PosedBones& posed);

/// resting_legs() whose knees bend as they do in the clips, as far as they do.
Legs find_legs(const Kinematics& kinematics, const std::vector<Clip>& clips);

}  // namespace fragmotion

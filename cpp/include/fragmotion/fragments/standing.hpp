// SPDX-License-Identifier: MIT
#pragma once

#include "fragmotion/fragments/fragment.hpp"
#include "fragmotion/skeleton/two_bone_ik.hpp"

namespace fragmotion {

/// A character that stands for `frames` frames: the mean pose of the pool's slowest fragments, on the ground that they
/// stand on, with both feet flat under their hip joints and the legs nearly straight. Symmetric where the pool holds
/// the fragments' mirror images. A skeleton without two legs keeps those of the mean pose.
Clip standing(const Kinematics& kinematics, const Legs& legs, const FragmentPool& pool, int frames, double rate);

}  // namespace fragmotion

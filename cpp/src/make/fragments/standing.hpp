// SPDX-License-Identifier: MIT
#pragma once

#include "fragments/fragment.hpp"
#include "skeleton/two_bone_ik.hpp"

namespace fragmotion {

/// s that takes stand, so that one does not see it begin again.
constexpr double kStandsLong = 3;

/// A character that stands for `frames` frames: the mean pose of the pool's slowest fragments, on the ground that they
/// stand on, with both feet flat under their hip joints and the legs nearly straight. Symmetric where the pool holds
/// the fragments' mirror images. A skeleton without two legs keeps those of the mean pose.
Clip standing(const Kinematics& kinematics, const Legs& legs, const FragmentPool& pool, int frames, double rate);

/// The same, alive: the body sways over its feet, which stay where they are, shifts its weight, breathes and looks
/// around, by 1/f noise as people do who stand for long (Duarte and Zatsiorsky, "Patterns of center of pressure
/// migration during prolonged unconstrained standing", Motor Control 3, 1999). After `cycle` frames it begins again.
Clip living_stand(const Kinematics& kinematics, const Legs& legs, const FragmentPool& pool, int cycle, int frames,
                  double rate);

}  // namespace fragmotion

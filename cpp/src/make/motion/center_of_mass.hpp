// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "motion/clip.hpp"
#include "skeleton/two_bone_ik.hpp"

namespace fragmotion {

/// The share of the body's mass that each bone carries, summing to 1: segment masses by role (Dempster's, in Winter,
/// "Biomechanics and Motor Control of Human Movement": head 8.1 %, trunk 49.7 %, upper arm 2.8, forearm 1.6, hand 0.6,
/// thigh 10.0, shank 4.65, foot 1.45), equal masses where the skeleton has no head, hands and feet.
std::vector<double> segment_masses(const Skeleton& skeleton);

/// World position of the centre of mass of a pose, m: the mean of the bones' midpoints by segment_masses().
Vector3 center_of_mass(const Skeleton& skeleton, const std::vector<double>& masses, const PosedBones& posed);

/// World position of the centre of mass in every frame of the clip, m.
std::vector<Vector3> center_of_mass(const Kinematics& kinematics, const Clip& clip);

}  // namespace fragmotion

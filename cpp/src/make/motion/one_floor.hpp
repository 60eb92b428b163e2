// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "motion/foot_paths.hpp"

namespace fragmotion {

/// Of the variance of the heights at which feet stand, that a slope explains at least which is one.
constexpr double kExplained = 0.7;

/// How much the floor rises along x and y on which these feet stand: that of a studio whose vertical was told wrong.
/// 0 where it rises by no more than soles do that are flat on it, where they stand within a leg's length, and where it
/// rises by more within one than a foot on a level floor may stand over it: that is a ramp or stairs. `hips`: their
/// path.
Vector2 floor_slope(const Skeleton& skeleton, const FootPaths& paths, const std::vector<Vector3>& hips, double rate);

/// Turns a clip level by its floor_slope(), and returns its contacts: else feet stand higher and higher along a walk,
/// and each fragment on a floor of its own.
Contacts put_level(const Kinematics& kinematics, Clip& clip);

/// Moves clips up or down onto one floor, the usual_floors() of their contacts, which come along: captured on different
/// days and of different actors, feet stand some centimetres higher in one take than in another, and a body that goes
/// from one to the other sinks in. The foot whose ball or heel stands lowest beside the usual one tells by how much, so
/// that whoever tiptoes or lies is not pushed into the ground; of a body on four legs the balls alone.
void put_on_one_floor(std::vector<Clip>& clips, std::vector<Contacts>& contacts);

/// The one and then the other, of takes as a build learns them; returns their contacts.
std::vector<Contacts> put_level_on_one_floor(const Kinematics& kinematics, std::vector<Clip>& clips, int threads = 1);

}  // namespace fragmotion

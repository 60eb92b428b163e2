// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string>

#include "retarget/body.hpp"

namespace fragmotion {

/// How far the limbs of a clip are from those of the actor's that it was made of, rad, each the mean over poses, by
/// role_label(): the angle between where both lead in the world. A hand or a foot is taken to lead where the bone
/// before it does when it is straight: the target's at rest, where that is a standing body's, the actor's in the pose
/// that bodies are compared in. Of limbs that both have. The clips have as many frames.
std::map<std::string, double> limb_angles(const Body& source, const Clip& from, const Body& target, const Clip& to);

}  // namespace fragmotion

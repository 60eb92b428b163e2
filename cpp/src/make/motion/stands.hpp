// SPDX-License-Identifier: MIT
#pragma once

#include "motion/clip.hpp"
#include "skeleton/kinematics.hpp"

namespace fragmotion {

/// Whether a body stands in any frame of a clip: its hips are more over the middle between its feet than beside it. A
/// body without feet is taken to.
bool stands(const Kinematics& kinematics, const Clip& clip);

}  // namespace fragmotion

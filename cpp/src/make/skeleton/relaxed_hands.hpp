// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "skeleton/skeleton.hpp"

namespace fragmotion {

/// The bones of the fingers, but for thumbs and for metacarpal bones, of hands of which two at least have them: those
/// that find_role_map() tells.
std::vector<int> finger_bones(const Skeleton& skeleton);

/// Rotations [bones, 4] as in Clip of the rest pose with relaxed hands: fingers beside each other, and bent at the
/// knuckle by 45 degrees, at the middle joint by 37.5 and at the last by 15, each the middle of what K.-S. Lee and
/// M.-C. Jung, "Ergonomic evaluation of biomechanical hand function" (Safety and Health at Work 6, 2015), give for a
/// hand at rest. Thumbs rest.
std::vector<double> relaxed_pose(const Skeleton& skeleton);

}  // namespace fragmotion

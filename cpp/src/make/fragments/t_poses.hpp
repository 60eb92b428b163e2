// SPDX-License-Identifier: MIT
#pragma once

#include "fragments/fragment.hpp"

namespace fragmotion {

/// Leaves out of the pool's fragments those of a T pose, with the swings of the arms to it and back: stands whose
/// arms_out() is that of a T pose from end to end, and those beside them in their take that hold the arms at least half
/// as far out. Else a character would stand as for a calibration. All stay where that is how most fragments hold the
/// arms, as those of legs alone, and where nothing else would be left. Needs the fragments' evident controls.
void drop_t_poses(FragmentPool& pool, const ControlSpace& space);

}  // namespace fragmotion

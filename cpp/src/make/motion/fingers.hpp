// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "motion/clip.hpp"
#include "skeleton/skeleton.hpp"

namespace fragmotion {

/// The clip, with those finger_bones() that rest in all of it as in a pose's rotations [bones, 4].
Clip with_fingers(const Skeleton& skeleton, Clip clip, const std::vector<double>& pose);

/// Those finger_bones() that stand in one and the same way in all of the clips, in ascending order; none where there
/// are no clips.
std::vector<int> still_fingers(const Skeleton& skeleton, const std::vector<Clip>& clips);

}  // namespace fragmotion

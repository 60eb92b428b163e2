// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "motion/clip.hpp"

namespace fragmotion::bindings {

/// Throws std::invalid_argument on a clip that has not the skeleton's number of bones.
void check_bones(const Clip& clip, const Skeleton& skeleton);
void check_bones(const std::vector<Clip>& clips, const Skeleton& skeleton);

}  // namespace fragmotion::bindings

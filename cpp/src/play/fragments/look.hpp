// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "fragments/fragment.hpp"
#include "fragments/gaze_range.hpp"

namespace fragmotion {

/// The bones of neck and head: those above the bone that the arms hang from, or the head alone where there is none.
/// Empty without a head below the hips.
std::vector<int> look_bones(const Skeleton& skeleton);

/// What neck and head do in takes, seen from the world.
struct Looks {
  std::vector<float> fastest;  ///< How fast each of look_bones() ever turns, rad/s over a thirtieth of a second.
  GazeRange gaze;
};

/// That of the captured takes of pools of one skeleton, which are read once. Empty without look_bones().
Looks looks_in(const std::vector<const PackedPool*>& pools);

}  // namespace fragmotion

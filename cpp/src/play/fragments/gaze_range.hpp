// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "fragments/fragment.hpp"

namespace fragmotion {

/// How a head looks about in takes, seen from where the character faces. Angles in rad.
struct GazeRange {
  Vector3 forward = Vector3::UnitY();  ///< Straight ahead, as the head sees it: where it looks on the mean.
  double turn = 0;                     ///< By so much it turns to either side,
  double chest = 0;                    ///< and of that the chest, no more than the whole.
  double down = 0, up = 0;             ///< Its pitch, down .. up: 0 is level, up is positive.
};

/// That of the takes of pools of one skeleton, each angle but for the hundredth of their time in which it is beyond,
/// and at least what a head does without effort. All 0 without bones of the head (look_bones()).
GazeRange gaze_range(const std::vector<const PackedPool*>& pools);

}  // namespace fragmotion

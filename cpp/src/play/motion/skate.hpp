// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>

namespace fragmotion {

/// m of a character of 1.8 m over the ground, from where on it does not count what a foot's point slides (Zhang,
/// Starke, Komura and Saito, "Mode-adaptive neural networks for quadruped motion control", SIGGRAPH 2018).
constexpr double kSkateHeight = 0.025;

/// How much it counts at a height: 1 on the ground, and less and less up to kSkateHeight (likewise).
inline double skate_weight(double height) { return std::clamp(2 - std::exp2(height / kSkateHeight), 0.0, 1.0); }

}  // namespace fragmotion

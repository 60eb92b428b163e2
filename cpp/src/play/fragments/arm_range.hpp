// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <vector>

#include "fragments/fragment.hpp"
#include "skeleton/two_bone_ik.hpp"

namespace fragmotion {

/// An arm, and how takes hold it.
struct ArmRange {
  Arm arm;
  double widest = 0;  ///< rad: how far from forward_aside() it points, and is let point.
};

/// Between straight ahead and the side (0: left, 1: right), level, in the character frame: about where the directions
/// in which a shoulder lets an arm point have their middle.
Vector3 forward_aside(int side);

/// The left and the right arm as the captured fragments of pools of one skeleton begin: each elbow's hinge is the axis
/// that it bends about on the mean, or, where it hardly does, what bends it forward from the rest pose; and an arm
/// points as far as it does but for the hundredth that is farthest, and at least as far as shoulders do easily.
std::array<ArmRange, 2> arm_ranges(const std::vector<const PackedPool*>& pools);

}  // namespace fragmotion

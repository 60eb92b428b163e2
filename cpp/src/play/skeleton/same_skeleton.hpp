// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "skeleton/skeleton.hpp"

namespace fragmotion {

/// Whether motion of one skeleton is motion of the other as it stands: the same bones with the same parents and hips,
/// and below the hips the same rest rotations in the world and the same lengths, to 1/1000 of the stature. Where the
/// hips and what is above or beside them stand at rest does not count: takes put the hips where they are.
bool same_skeleton(const Skeleton& a, const Skeleton& b);

/// Indices of the skeletons that are the same as a group's first, groups and members in the order given.
std::vector<std::vector<int>> group_skeletons(const std::vector<Skeleton>& skeletons);

}  // namespace fragmotion

// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "fragments/fragment.hpp"

namespace fragmotion {

/// The bones of neck and head: those above the bone that the arms hang from, or the head alone where there is none.
/// Empty without a head below the hips.
std::vector<int> look_bones(const Skeleton& skeleton);

/// How fast each of them ever turns in the takes, seen from the world, rad/s over a thirtieth of a second.
std::vector<float> fastest_looks(const PackedPool& pool);

}  // namespace fragmotion

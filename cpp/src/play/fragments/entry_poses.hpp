// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "fragments/fragment.hpp"

namespace fragmotion {

/// How much of its motion decides how well a fragment joins on to another, s: so much of one is played at least before
/// a change of the control may end it.
constexpr double kEntry = 0.1;

/// s between the moments that are looked at for leaving a fragment: of its entry the middle, too.
constexpr double kMomentsApart = kEntry / 2;

/// The first pose of each fragment and the one kEntry later, both in the character frame of the first: [fragments, 3,
/// padded(2 * tips)], as Dis sees them. The distance between two says how alike places and speeds are. Takes some
/// microseconds a fragment, so that a policy file need not hold them.
std::vector<float> entry_poses(const PackedPool& pool);
/// The same of other fragments of its clips.
std::vector<float> entry_poses(const PackedPool& pool, const std::vector<Fragment>& fragments);

}  // namespace fragmotion

// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "fragments/fragment.hpp"

namespace fragmotion {

/// [fragments] the fragment with which the motion of each goes on: the one of the same clip and origin that begins
/// where it ends, or after the last one of a gait or a stand that was made, which are cycles, the first. -1: there is
/// none.
std::vector<int> successors(const std::vector<Fragment>& fragments);

}  // namespace fragmotion

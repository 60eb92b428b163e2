// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "runtime/transition_cost.hpp"

namespace fragmotion {

/// [controls] the gait of each while it is held: of all fragments that follow each other by their successors() under it
/// and lead back to the first of them, captured and made alike, those that cost least (transition_cost.hpp) for what
/// they perform together and, a step, for entering the first again. Their feet come down in turns. At most kLanes
/// fragments; none of what jumps or does not ask to go, and where there are none.
std::vector<std::vector<int>> held_gaits(const Character& character, const TransitionCost& cost,
                                         const std::vector<int>& successors, const std::vector<EntrySteps>& steps);

}  // namespace fragmotion

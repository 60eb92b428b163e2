// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "runtime/transition_cost.hpp"

namespace fragmotion {

/// [controls] with which fragments the gait of each begins, anew and anew, while it is held, the best one first. A
/// cycle is at most kLanes fragments that follow each other by their successors() under it and lead back to the first
/// of them, feet coming down in turns. It costs (transition_cost.hpp) what they perform together and, a step, entering
/// the first again. Those of a gait are of one take, as others have other manners; they cost no more than `variety`
/// above the least, perform as asked for no more than the best one costs in whole, and begin in poses that join on to a
/// fragment of the best one at `variety` at most, so that a held walk varies but neither ducks nor changes its manner.
/// Where a made cycle costs least, no take goes as asked: that one alone, all of its fragments. None of what jumps or
/// does not ask to go, and where there are none.
std::vector<std::vector<int>> held_gaits(const Character& character, const TransitionCost& cost,
                                         const std::vector<int>& successors, const std::vector<EntrySteps>& steps,
                                         float variety);

}  // namespace fragmotion

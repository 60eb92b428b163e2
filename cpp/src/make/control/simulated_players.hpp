// SPDX-License-Identifier: MIT
#pragma once

#include "control/simulated_players.hpp"
#include "control/trace.hpp"

namespace fragmotion {

/// The names that simulate_trace knows: walker, stroller, runner, sprinter, twitcher, jumper, circler, explorer.
const std::vector<std::string>& simulated_players();

/// A trace of a simulated player: a stick with inertia (critically damped spring) that chases targets, held for a
/// random while, drawn from the player's habits; snapped to the points of `space`. Deterministic on every platform.
/// Throws std::invalid_argument on an unknown player (listing the known ones), fewer than 2 controls or
/// more than a day.
Trace simulate_trace(const std::string& player, double seconds, std::uint64_t seed, const ControlSpace& space);

}  // namespace fragmotion

// SPDX-License-Identifier: MIT
#pragma once

#include "runtime/player.hpp"

namespace fragmotion {

/// How fast a player answers: a time for every step of the command from one of the 17 velocities to another (272 steps,
/// no turn, no jump), from the step until the velocity over the last 0.1 s has made 90 % of the way, s, between what
/// the character is able to do of both; 0 where that is one and the same. The command is held for 1.5 to 2 s before
/// each step, so that steps meet every phase of a gait; an answer that takes more than kNoResponse counts as that.
/// Arguments as Player's.
std::vector<double> response_times(const std::shared_ptr<const Character>& character,
                                   const PlayerOptions& options = {});

/// s
constexpr double kNoResponse = 3;
/// Of what was asked for: who does so much of it has answered.
constexpr double kAnswered = 0.9;

}  // namespace fragmotion

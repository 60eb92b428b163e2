// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>

#include "character/character.hpp"

namespace fragmotion::benchmarks {

/// Registers what is measured of a character by name: a frame with free and with locked feet, under a stick that is
/// held and under a restless one, and a player on stairs, which also tells how often a step asks for the ground.
void register_frames(const std::string& name, const std::shared_ptr<const Character>& character);

}  // namespace fragmotion::benchmarks

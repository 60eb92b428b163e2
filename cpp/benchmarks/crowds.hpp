// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>

#include "character/character.hpp"

namespace fragmotion::benchmarks {

/// Registers what is measured of a crowd of a character by name: 10,000 that hold their feet, on one thread and on two,
/// and 50,000 of which those far off hold none and step in every second or fourth frame, and how far these are off.
void register_crowds(const std::string& name, const std::shared_ptr<const Character>& character);

}  // namespace fragmotion::benchmarks

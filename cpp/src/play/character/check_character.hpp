// SPDX-License-Identifier: MIT
#pragma once

#include "character/character.hpp"

namespace fragmotion {

/// Throws std::invalid_argument, which names the parts that do not fit together, unless a character is all that it must
/// be to be saved and played, in each of its styles.
void check_character(const Character& character);

/// Likewise of its looks and arms, which files of before version 6 do not hold.
void check_looks_and_arms(const Character& character);

}  // namespace fragmotion

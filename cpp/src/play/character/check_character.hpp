// SPDX-License-Identifier: MIT
#pragma once

#include "character/character.hpp"

namespace fragmotion {

/// Throws std::invalid_argument, which names the parts that do not fit together, unless a character is all that it must
/// be to be saved and played, in each of its styles.
void check_character(const Character& character);

}  // namespace fragmotion

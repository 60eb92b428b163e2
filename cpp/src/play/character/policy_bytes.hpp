// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "character/character.hpp"

namespace fragmotion {

/// to_bytes() of a character that from_bytes() may refuse: what a forger would write.
std::string unchecked_bytes(const Character& character);

}  // namespace fragmotion

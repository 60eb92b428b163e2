// SPDX-License-Identifier: MIT
#pragma once

#include "character/character.hpp"

namespace fragmotion {

/// The character that is never sent to the excluded classes: their second factor of Eq. 2 is 0, no table says them, no
/// stand-in-place fragment is of them, and a reset does not begin with them. Where a table said one, it says the other
/// class of the greatest Eq. 2 and value to come (future_values()); ties go to the lower class. They can still be
/// played by Player::force. The classes are those of one style; the others stay as they are. Throws
/// std::invalid_argument where a class or the style does not exist or no class would be left.
Character without_classes(const Character& character, const std::vector<int>& excluded, int style = 0);

}  // namespace fragmotion

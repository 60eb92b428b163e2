// SPDX-License-Identifier: MIT
#pragma once

#include "character/character.hpp"

namespace fragmotion {

/// What performing a control is called, by the nearest point (Sec. 3.1): "stand", "walk forward left",
/// "sidestep left", "run back", "turn left in place", "walk forward turning left", "jump up", "jump forward",
/// "running jump forward" ... Each point has a name of its own.
std::string control_name(const ControlSpace& space, const Control& control);

/// A name for each class: that of its representative's evident control, and a number from 2 on where a class before it
/// is called the same.
std::vector<std::string> class_names(const Character& character);

}  // namespace fragmotion

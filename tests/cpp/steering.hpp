// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

#include "runtime/player.hpp"

namespace fragmotion {

/// Seconds of a frame that tests play.
constexpr double kStep = 1.0 / 60;
inline const Control kForward{0, 1.2, 0, 0}, kStand{};

/// Plays for so long with a control that whatever was before has gone by.
inline void settle(Player& player, const Control& control, double seconds = 2) {
  for (int f = 0; f < std::lround(seconds / kStep); ++f) player.step(control, kStep);
}

}  // namespace fragmotion

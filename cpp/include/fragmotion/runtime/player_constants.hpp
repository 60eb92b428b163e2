// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string>

namespace fragmotion {

/// Of a stitch (inertialization.hpp).
struct StitchConstants {
  double fades = 2.4;  ///< Time constants of the offset in PlayerOptions::stitch; (1 + 2.4) exp(-2.4) is three tenths.
  double calms = 12;   ///< 1/s: at least so fast fade speeds, which carry a pose too far in a long stitch.
};

/// What the run time cannot derive from the character's takes nor from physics. `dev.py tune` fits these by what
/// players and viewers see; a game leaves them as they are.
struct PlayerConstants {
  StitchConstants stitch;
};

/// Calls `visit(name, value)` with each of the constants.
template <typename Constants, typename Visit>
void for_each_constant(Constants& constants, const Visit& visit) {
  visit("stitch_fades", constants.stitch.fades);
  visit("stitch_calms", constants.stitch.calms);
}

/// The constants, but for those that `values` names. Throws std::invalid_argument on a name that there is not, and
/// unless each value is over 0 and at most a thousand.
PlayerConstants player_constants(const std::map<std::string, double>& values);

}  // namespace fragmotion

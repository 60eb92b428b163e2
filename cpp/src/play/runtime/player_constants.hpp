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
inline constexpr StitchConstants kUsualStitch{};

/// What a body can do of a command beyond what its fragments show. The rest follows from the takes.
struct RootLimits {
  double acceleration = 4.8;  ///< m/s^2 of a 1.8 m character: of the velocity, at a responsiveness of a half.
  double stride = 0.6;        ///< Of a fragment's speed: by so much its strides are made longer or shorter at most.
  double slowest = 0.75;      ///< Of the captured tempo: at least so fast, and
  double fastest = 1.2;       ///< at most so fast its steps follow each other.
  double settles = 0.03;      ///< s: time constant of what is added to what plays.
  double sways = 0.05;        ///< m/s of a 1.8 m character: at most so fast one sways that stands.
};

/// What the run time cannot derive from the character's takes nor from physics. `dev.py tune` fits these by what
/// players and viewers see; a game leaves them as they are.
struct PlayerConstants {
  StitchConstants stitch;
  RootLimits root;
};

/// Calls `visit(name, value)` with each of the constants.
template <typename Constants, typename Visit>
void for_each_constant(Constants& constants, const Visit& visit) {
  visit("stitch_fades", constants.stitch.fades);
  visit("stitch_calms", constants.stitch.calms);
  visit("root_acceleration", constants.root.acceleration);
  visit("root_stride", constants.root.stride);
  visit("root_slowest", constants.root.slowest);
  visit("root_fastest", constants.root.fastest);
  visit("root_settles", constants.root.settles);
  visit("root_sways", constants.root.sways);
}

/// The constants, but for those that `values` names. Throws std::invalid_argument on a name that there is not, and
/// unless each value is over 0 and at most a thousand.
PlayerConstants player_constants(const std::map<std::string, double>& values);

}  // namespace fragmotion

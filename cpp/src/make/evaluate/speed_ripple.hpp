// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>

#include "evaluate/jumps.hpp"
#include "runtime/player.hpp"

namespace fragmotion {

/// How a body goes for a second, which is about a gait cycle: m/s of a 1.8 m character.
struct Going {
  double speed = 0;   ///< Of the centre of mass along the ground, mean.
  double ripple = 0;  ///< Standard deviation of its speed over 0.1 s in the mean direction.
  double bob = 0;     ///< Standard deviation of the hips' height, m.
  double steps = 0;   ///< How often a foot comes to stand; 0 without feet.
};

/// Of each second that begins at `first` or a later frame; none where the track is shorter. It stands on its floors.
std::vector<Going> goings(const BodyTrack& track, int first = 0);

/// Of each second in which it goes forward, within 30 degrees of where it faces, and steadily: the mean velocities of
/// the half seconds around its beginning and its end differ by at most a tenth of its speed. None in a jump, nor in
/// the half second before and after it, of a body whose heights are usually so.
std::vector<Going> steady_goings(const BodyTrack& track, const UsualHeights& usual);

/// How evenly a character goes at a speed, m and m/s of a 1.8 m character; NaN where the takes do not go steadily.
struct SpeedRipple {
  double commanded = 0;
  double speed = 0;         ///< Mean, reached.
  double ripple = 0;        ///< Means of Going::ripple
  double bob = 0;           ///< and Going::bob
  double steps = 0;         ///< and Going::steps.
  double takes_speed = 0;   ///< Of the captured takes' steady seconds, the one nearest to the command,
  double takes_ripple = 0;  ///< and the means of all that are within 0.1 m/s of it.
  double takes_bob = 0;
  double takes_steps = 0;
};

/// For forward commands of 0.5, 1, 1.5 ... 3 m/s of a 1.8 m character, each held for 11 s, of which the first three do
/// not count. Arguments as Player's.
std::vector<SpeedRipple> speed_ripples(const std::shared_ptr<const Character>& character,
                                       const PlayerOptions& options = {});

}  // namespace fragmotion

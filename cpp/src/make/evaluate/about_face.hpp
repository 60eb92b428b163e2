// SPDX-License-Identifier: MIT
#pragma once

#include "runtime/player.hpp"

namespace fragmotion {

/// How soon a player that walks forward walks the other way, forward again, by turning: a time for each of 16 trials,
/// to the left and to the right in turn, s. A walk at the space's speed is held for 1.5 to 2 s. Then it is steered as a
/// stick does that is pulled back, seen from behind the character: it turns by ControlSpace::turn_towards(), on the
/// spot until it is 100 degrees off where it shall face, and walks from there on. The time is that from the first
/// command to turn until it faces there to 15 degrees and the velocity over the last 0.1 s is nine tenths of the walk
/// or more straight back, in the world. What takes more than kNoAboutFace counts as that. Arguments as Player's.
std::vector<double> about_face_times(const std::shared_ptr<const Character>& character,
                                     const PlayerOptions& options = {});

/// rad by which a way is off another at least that leads back.
constexpr double kTurnsBack = 100 * kPi / 180;
/// s
constexpr double kNoAboutFace = 10;

}  // namespace fragmotion

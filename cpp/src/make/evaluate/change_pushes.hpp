// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "evaluate/spread.hpp"
#include "runtime/player.hpp"

namespace fragmotion {

/// What changes when the stick moves: it leaves rest or comes to rest; goes to the other side, by more than 100
/// degrees; to another direction, or begins or ends a turn; or to another speed the same way.
enum class Change { start, stop, reverse, turn, gait };
constexpr int kChanges = 5;

/// The kind of a change from one control to another, which differ.
Change kind_of(const Control& from, const Control& to);

/// What a change does to a body.
struct ChangePushes : Pushes {
  double dragged = 0;  ///< m that its feet go lower than those of the takes that are as fast, after each: Dragging.
};

/// How hard the centre of mass is pushed along the ground in the 1.5 s after a change of the command, m/s^2 of a 1.8 m
/// character, by its kind: of every change between two of the 17 velocities, and of walking and running forward between
/// no turn and either turn. Before each change the command is held for 1.5 to 2 s. Arguments as Player's.
std::array<ChangePushes, kChanges> change_pushes(const std::shared_ptr<const Character>& character,
                                                 const PlayerOptions& options = {});

}  // namespace fragmotion

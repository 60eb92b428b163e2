// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "runtime/player.hpp"

namespace fragmotion {

/// [controls] what the character's player does of what it can be asked for. Each control without a jump is asked for
/// over six seconds from a stand: done is one whose mean velocity over the last four is within a fifth of the speed,
/// and whose turn rate is within 30 % of the full one, or, where it stands, that goes no faster than 0.1 m/s of a
/// character of 1.8 m. Of the controls with a jump those are done that a fragment performs (kPerformed).
/// Deterministic whatever the number of threads.
std::vector<char> abilities(const std::shared_ptr<const Character>& character, int threads = 0);

/// The names of the controls without turn or jump, of which one is to stand, that are not `done` [controls], as
/// abilities() tells.
std::vector<std::string> undone_controls(const ControlSpace& space, const std::vector<char>& done);

}  // namespace fragmotion

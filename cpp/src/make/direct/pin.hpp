// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "base/progress.hpp"
#include "base/rates.hpp"
#include "control/trace.hpp"
#include "runtime/player.hpp"

namespace fragmotion {

/// Where a character is to be: `seconds` after the first control, at `frame`.
struct PinGoal {
  double seconds = 0;
  CharacterFrame frame;
};

struct PinOptions {
  double begin = 0;              ///< s: controls before it stay as they are, and what follows the pin.
  double distance = 0.02;        ///< m, 0 .. 100, and
  double angle = 2 * kPi / 180;  ///< rad, 0 .. pi: so near is near enough.
  int tries = 4000;              ///< At most, 1 .. 1e6; up to as many more as fill the last round.
  int threads = 0;               ///< 0: the machine's
};

/// A trace that leads a player to a pin, or as near as was found.
struct Pin {
  Trace trace;
  std::uint64_t seed = 0;
  CharacterFrame reached;
  double asked = 0, asked_angle = 0;  ///< How far the trace was from the pin before; m, rad.
  double distance = 0, angle = 0;     ///< How far it is now; m, rad.
  int tries = 0;
  bool fits = false;  ///< Whether that is near enough.
};

/// Looks for small changes of a trace's controls between `begin` and the pin, by which a player that is reset to
/// `start` and stepped kGameRate times a second is at the pin: in speed by two fifths at most, in direction by 20
/// degrees, in turn by 0.6, as three smooth bumps each; who stands goes on standing. Where it begins with the trace
/// the seed changes, too. The search is by rounds of the cross-entropy method (R. Rubinstein 1999), begun anew where
/// it has settled and is not there. The same result whatever the thread count. Throws std::invalid_argument on options
/// out of their ranges, a trace with no controls, and unless 0 <= begin < the pin's seconds <= the trace's, a control's
/// time apart at least; Cancelled.
Pin find_pin(const std::shared_ptr<const Character>& character, const PlayerOptions& player,
             const CharacterFrame& start, const Trace& trace, const PinGoal& goal, const PinOptions& options = {},
             const Progress& progress = {});

}  // namespace fragmotion

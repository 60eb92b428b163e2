// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "character/character.hpp"

namespace fragmotion {

/// How the feet of a body that goes came down so far: with feet that alternate, the other one is next.
struct StepSequence {
  std::array<bool, 2> stands{};  ///< left, right
  int last = -1;                 ///< The foot that came down last; -1 before the first.
  double since = 0;              ///< s since then

  /// A time later the feet stand so.
  void advance(const std::array<bool, 2>& now, double seconds);
};

/// Which feet stand in the first pose of a fragment, and when each comes down after it, s; infinity where it does not
/// before the clip ends.
struct EntrySteps {
  std::array<bool, 2> stands{};
  std::array<float, 2> strikes{};
};

/// Of all fragments of a character, by their successors().
std::vector<EntrySteps> entry_steps(const Character& character, const std::vector<int>& successors);

/// A step takes no longer, s: feet that come down less often do not go on steps.
constexpr double kLongestStep = 1;

/// How long the steps take that each fragment of a character is one or a part of: the median of the times between
/// strikes from kLongestStep before it to as long after it, at most kLongestStep; that where there are not two strikes.
std::vector<double> step_seconds(const Character& character);

/// Whether each foot stands in a frame; neither without feet.
std::array<bool, 2> standing_feet(const Contacts& contacts, std::size_t frame);

/// How many feet come down out of turn where a fragment is entered after these steps: the foot that came down last,
/// or one less than 0.25 s after the other. 0 to 2.
int steps_out_of_turn(const StepSequence& steps, const EntrySteps& entry);

}  // namespace fragmotion

// SPDX-License-Identifier: MIT
#pragma once

#include "bake/motion.hpp"

namespace fragmotion {

/// A motion at another rate, and which frame of the one before is nearest to each of its own.
struct Resampled {
  Motion motion;
  std::vector<int> nearest;  ///< [frames]
};

/// A motion whose frames were shown at `times` (s, ascending from 0) at a fixed rate (frames a second): straight lines
/// between what was shown.
Resampled resampled(const std::vector<double>& times, const Motion& motion, double rate);

}  // namespace fragmotion

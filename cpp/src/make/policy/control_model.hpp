// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "control/control.hpp"

namespace fragmotion {

/// What is believed of every control before any trace is seen: so many times it stayed, and so many times it was
/// followed by any of the controls, each as often. Counts 0 to 1e9.
struct ControlPrior {
  double stays = 0;
  double goes_anywhere = 0;
};

/// P(c' | c) learned from traces of control indices: the prior's counts and those of the traces (McCann and Pollard
/// 2007). [controls, controls], rows sum to 1; a control of which nothing is known stays. Throws std::invalid_argument
/// on an index outside 0 .. controls - 1 and on a prior out of its range.
std::vector<double> control_model(const std::vector<std::vector<int>>& traces, const ControlPrior& prior,
                                  int controls = kPaperPoints);

}  // namespace fragmotion

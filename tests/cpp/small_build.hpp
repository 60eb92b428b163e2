// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "build/build.hpp"
#include "control/simulated_players.hpp"
#include "small_character.hpp"

namespace fragmotion {

// What a build takes little time of.
inline std::vector<Trace> some_traces() { return {simulate_trace("explorer", 20, 1, ControlSpace())}; }

inline BuildOptions few_classes(const std::string& policy = "greedy") {
  BuildOptions options;
  options.classes = 15;
  options.policies = {policy};
  return options;
}

inline std::vector<Clip> some_takes() {
  const std::vector<Clip> all = gait_takes();
  return {all[0], all[1], all[9], all[10]};
}

}  // namespace fragmotion

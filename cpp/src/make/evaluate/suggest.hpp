// SPDX-License-Identifier: MIT
#pragma once

#include "build/build.hpp"
#include "character/character.hpp"

namespace fragmotion {

/// What a number of classes is good for: means over a minute of each simulated player, none of which teaches.
struct ClassesTried {
  int classes = 0;
  double quality = 0;         ///< Performance::quality.
  double velocity_error = 0;  ///< Performance::velocity_error over the commanded speed.
};

/// How many classes to build (Sec. 3.1: "by choosing an appropriate class number n").
struct Suggestion {
  int classes = 0;  ///< The fewest of those tried whose velocity error is at most a twentieth over the smallest.
  std::vector<ClassesTried> tried;
};

/// Builds and plays characters of 24, 34, 48, 68, 97, 137, 194 and 274 classes, as far as there are four fragments a
/// class, with the policy that drives. `options.classes` is not used. Throws as build().
Suggestion suggest_classes(const Skeleton& skeleton, const std::vector<Clip>& clips, const std::vector<Trace>& traces,
                           const BuildOptions& options = {}, const Progress& progress = {});

}  // namespace fragmotion

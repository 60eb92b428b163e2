// SPDX-License-Identifier: MIT
#pragma once

#include "base/random.hpp"
#include "policy/quality.hpp"

namespace fragmotion {

/// Random factors of Eq. 2 in (0, 1]. With `coarse` they are 1/4, 1/2 or 1: sums are exact, and ties are many.
inline Quality random_quality(Random& random, int classes, bool coarse = false) {
  const auto value = [&] { return coarse ? 1.0 / (1 << random.below(3)) : 1 / (1 + 3 * random.uniform()); };
  Quality quality;
  quality.classes = classes;
  for (int i = 0; i < classes * classes; ++i) quality.smoothness.push_back(value());
  for (int i = 0; i < classes * kPaperPoints; ++i) quality.match.push_back(value());
  return quality;
}

/// Random control indices; few different ones where `different` is small.
inline std::vector<int> random_trace(Random& random, int steps, int different = kPaperPoints) {
  std::vector<int> trace;
  for (int i = 0; i < steps; ++i) trace.push_back(random.below(different) * kPaperPoints / different);
  return trace;
}

}  // namespace fragmotion

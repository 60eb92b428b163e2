// SPDX-License-Identifier: MIT
#pragma once

#include "fragmotion/fragments/evident.hpp"
#include "fragmotion/fragments/fragment.hpp"

namespace fragmotion {

struct SynthesisOptions {
  double tolerance = 0.3;  ///< A fragment performs a control when ControlDis(Ev, control) is at most this, 0 .. 100.
  int wanted = 4;          ///< Fragments that should perform each control, 0 .. 1000.
  double longest = 0.5;    ///< s, 0.1 .. 10: longest fragment.
  double tail = 0.3;       ///< s, 0 .. 10, kept beyond a fragment's end, for stitching.
};

/// Adds fragments for the controls that fewer than `wanted` fragments perform: interpolations of similar fragments
/// whose evident controls lie around it, and a transformed gait cycle, cut into fragments that follow each other, so
/// that the control can be performed for long. `usual` is usual_height() of the takes. Throws std::invalid_argument on
/// an option out of its range.
void synthesize(FragmentPool& pool, const ControlSpace& space, double usual, const SynthesisOptions& options = {});

}  // namespace fragmotion

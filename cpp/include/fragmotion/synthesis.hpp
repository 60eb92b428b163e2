// SPDX-License-Identifier: MIT
#pragma once

#include "fragmotion/evident.hpp"
#include "fragmotion/fragment.hpp"

namespace fragmotion {

struct SynthesisOptions {
  double tolerance = 0.3;  ///< A fragment performs a control when ControlDis(Ev, control) is at most this.
  int wanted = 4;          ///< Fragments that should perform each control.
  double longest = 0.5;    ///< s: longest fragment.
  double tail = 0.3;       ///< s kept beyond a fragment's end, for stitching.
};

/// Adds fragments for the controls that fewer than `wanted` fragments perform: interpolations of similar fragments
/// whose evident controls lie around it, and a transformed gait cycle, cut into fragments that follow each other, so
/// that the control can be performed for long. `usual` is usual_height() of the takes.
void synthesize(FragmentPool& pool, const ControlSpace& space, double usual, const SynthesisOptions& options = {});

}  // namespace fragmotion

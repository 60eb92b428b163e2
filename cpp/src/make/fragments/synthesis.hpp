// SPDX-License-Identifier: MIT
#pragma once

#include "fragments/distance.hpp"
#include "fragments/evident.hpp"
#include "fragments/fragment.hpp"

namespace fragmotion {

/// Adds fragments for the controls, as fast as the takes' SpeedRange allows, that fewer than four fragments perform,
/// whose ControlDis to them is at most 0.3: interpolations of similar fragments whose evident controls lie around it.
/// And there, or where no two of a take that follow each other perform it together, a transformed gait cycle
/// (closed_cycles.hpp), cut into fragments of at most `longest` s (0.1 .. 10) that follow each other, so that the
/// control can be performed for long. Where no take stands for three seconds, a living_stand() is added, cut likewise.
/// `usual` is usual_height() of the takes; `threads` as of thread_count(); `known` are the trajectories() of fragments
/// of the pool, as they are given to these. Throws std::invalid_argument on a length out of its range.
void synthesize(FragmentPool& pool, const ControlSpace& space, double usual, double longest = 0.5, int threads = 0,
                const Trajectories& known = {});

}  // namespace fragmotion

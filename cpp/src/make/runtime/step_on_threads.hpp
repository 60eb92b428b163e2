// SPDX-License-Identifier: MIT
#pragma once

#include "base/parallel.hpp"
#include "runtime/crowd.hpp"

namespace fragmotion {

/// Crowd::step with a thread for each of the crowd's parts, to the same bits. For those who have no threads of their
/// own: the library starts none, this header's user does.
inline void step_on_threads(Crowd& crowd, const Control* controls, double seconds, double* roots = nullptr,
                            double* rotations = nullptr) {
  crowd.check_step(controls, seconds);
  parallel_for(crowd.parts(), crowd.parts(), [&](int begin, int end) {
    for (int part = begin; part < end; ++part) crowd.step_part(part, controls, seconds, roots, rotations);
  });
}

}  // namespace fragmotion

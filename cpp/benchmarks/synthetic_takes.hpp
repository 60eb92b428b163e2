// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "motion/clip.hpp"

namespace fragmotion::benchmarks {

/// A humanoid of 22 bones, 1.76 m tall.
Skeleton mannequin();

/// Made-up takes of the mannequin, 4 s at 30 frames a second, for measuring: standing, and going in 8 directions at a
/// walk and at a run, straight on and in curves, with jumps; each take in a style of its own. The first takes are the
/// same whatever the count, on every platform.
std::vector<Clip> synthetic_takes(int count);

}  // namespace fragmotion::benchmarks

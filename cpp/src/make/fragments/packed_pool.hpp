// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "fragments/fragment.hpp"
#include "motion/mirror.hpp"

namespace fragmotion {

/// Which clips of a pool are mirror images of others.
struct MirrorImages {
  std::vector<int> originals;  ///< Of each clip the number of its original, or -1; of clips beyond -1.
  MirrorTurns turns;           ///< Not empty where there are originals.
};

/// Packs the clips of a pool, images with their originals; the result does not depend on the number of threads.
PackedPool pack(const FragmentPool& pool, const MirrorImages& images = {}, int threads = 0);

}  // namespace fragmotion

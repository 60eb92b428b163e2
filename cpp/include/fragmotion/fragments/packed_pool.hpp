// SPDX-License-Identifier: MIT
#pragma once

#include "fragmotion/fragments/fragment.hpp"
#include "fragmotion/motion/packed_clip.hpp"

namespace fragmotion {

/// Fragments and the packed clips that hold their poses.
using PackedPool = Pool<PackedClip>;

/// Packs the clips of a pool; the result does not depend on the number of threads.
PackedPool pack(const FragmentPool& pool, int threads = 0);

}  // namespace fragmotion

// SPDX-License-Identifier: MIT
#pragma once

#include "fragments/fragment.hpp"

namespace fragmotion {

/// Packs the clips of a pool; the result does not depend on the number of threads.
PackedPool pack(const FragmentPool& pool, int threads = 0);

}  // namespace fragmotion

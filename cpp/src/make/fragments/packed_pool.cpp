// SPDX-License-Identifier: MIT
#include "fragments/packed_pool.hpp"

#include "base/parallel.hpp"

namespace fragmotion {

PackedPool pack(const FragmentPool& pool, int threads) {
  PackedPool packed{pool.skeleton, {}, pool.fragments};
  packed.clips.resize(pool.clips.size());
  const auto grid = std::make_shared<const PoseGrid>(pose_grid(pool.skeleton, pool.clips));
  parallel_for(static_cast<int>(pool.clips.size()), thread_count(threads), [&](int begin, int end) {
    for (int c = begin; c < end; ++c) packed.clips[c] = pack(pool.skeleton, grid, pool.clips[c]);
  });
  return packed;
}

}  // namespace fragmotion

// SPDX-License-Identifier: MIT
#include "fragments/packed_pool.hpp"

#include "base/parallel.hpp"
#include "motion/pack_clip.hpp"

namespace fragmotion {

PackedPool pack(const FragmentPool& pool, const MirrorImages& images, int threads) {
  PackedPool packed{pool.skeleton, {}, pool.fragments};
  std::vector<int> originals = images.originals;
  originals.resize(pool.clips.size(), -1);
  const auto grid = std::make_shared<const PoseGrid>(pose_grid(pool.skeleton, pool.clips, images.turns));
  packed.clips = parallel_map(static_cast<int>(pool.clips.size()), thread_count(threads), [&](int c) {
    return originals[c] < 0 ? pack(pool.skeleton, grid, pool.clips[c]) : PackedClip();
  });
  for (std::size_t c = 0; c < originals.size(); ++c) {
    if (originals[c] >= 0) packed.clips[c] = mirror_image(packed.clips[originals[c]], pool.clips[c].name);
  }
  return packed;
}

}  // namespace fragmotion

// SPDX-License-Identifier: MIT
#include "fragments/entry_poses.hpp"

#include "fragments/body_tips.hpp"
#include "motion/pose.hpp"

namespace fragmotion {

std::vector<float> entry_poses(const PackedPool& pool) { return entry_poses(pool, pool.fragments); }

std::vector<float> entry_poses(const PackedPool& pool, const std::vector<Fragment>& fragments) {
  TipWriter tips(pool.skeleton);
  const int points = tips.points(), stride = padded(2 * points);
  std::vector<float> poses(fragments.size() * 3 * stride, 0);
  float* rows = poses.data();
  for (const Fragment& f : fragments) {
    const PackedClip& clip = pool.clips[f.clip];
    const CharacterFrame frame = frame_at(clip, f.first_played());
    for (int later = 0; later < 2; ++later) {
      const Vector3 root = sample_pose(clip, f.first_played() + later * kEntry * clip.rate, tips.rotations());
      tips.add(root, frame, rows, stride, later * points);
    }
    rows += std::ptrdiff_t{3} * stride;
  }
  tips.flush();
  return poses;
}

}  // namespace fragmotion

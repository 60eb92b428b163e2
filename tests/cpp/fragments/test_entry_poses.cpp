// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "fragments/body_tips.hpp"
#include "fragments/entry_poses.hpp"
#include "fragments/packed_pool.hpp"
#include "motion/pose.hpp"
#include "walker.hpp"

namespace fragmotion {
namespace {

TEST(EntryPoses, AreTheFirstPoseAndTheOneATenthOfASecondLaterAsSeenFromThere) {
  const FragmentPool pool = gait_pool(gait_takes());
  const PackedPool packed = pack(pool);
  const std::vector<float> made = entry_poses(packed);
  BodyTips tips(pool.skeleton);
  const int points = tips.points(), stride = padded(2 * points);
  ASSERT_EQ(made.size(), pool.fragments.size() * 3 * stride);
  std::vector<double> rotations(std::size_t{4} * pool.skeleton.size());
  std::vector<float> expected(std::size_t{3} * stride, 0);
  for (std::size_t i = 0; i < pool.fragments.size(); ++i) {
    const Fragment& f = pool.fragments[i];
    const Clip& clip = pool.clips[f.clip];
    for (const double later : {0.0, 0.1}) {
      tips.pose(sample_pose(clip, f.begin + later * clip.rate, rotations.data()), rotations.data());
      tips.write(frame_at(clip, f.begin), expected.data(), stride, later > 0 ? points : 0);
    }
    EXPECT_LT(tip_distance(expected.data(), &made[i * 3 * stride], stride) / (2 * points), 1e-3) << i;
  }
}

}  // namespace
}  // namespace fragmotion

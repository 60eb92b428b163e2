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

// The largest mean distance of a fragment's tips from those that its clip shows, m, of walks and their mirror images.
double farthest(FragmentPool pool) {
  const Kinematics kinematics(pool.skeleton);
  const Mirror mirror(kinematics, pool.clips);
  const int takes = static_cast<int>(pool.clips.size());
  std::vector<int> originals(takes, -1);
  for (int c = 0; c < takes; ++c) {
    pool.clips.push_back(mirror(pool.clips[c]));
    originals.push_back(c);
  }
  for (std::size_t i = 0, count = pool.fragments.size(); i < count; ++i) {
    pool.fragments.push_back(pool.fragments[i]);
    pool.fragments.back().clip += takes;
  }
  const PackedPool packed = pack(pool, {originals, mirror.turns()});
  const std::vector<float> made = entry_poses(packed);
  BodyTips tips(pool.skeleton);
  const int points = tips.points(), stride = padded(2 * points);
  std::vector<double> rotations(std::size_t{4} * pool.skeleton.size());
  std::vector<float> shown(std::size_t{3} * stride, 0);
  double most = 0;
  for (std::size_t i = 0; i < pool.fragments.size(); ++i) {
    const Fragment& f = pool.fragments[i];
    const PackedClip& clip = packed.clips[f.clip];
    for (const double later : {0.0, kEntry}) {
      tips.pose(sample_pose(clip, f.begin + later * clip.rate, rotations.data()), rotations.data());
      tips.write(frame_at(clip, f.begin), shown.data(), stride, later > 0 ? points : 0);
    }
    most = std::max<double>(most, tip_distance(shown.data(), &made[i * 3 * stride], stride) / (2 * points));
  }
  return most;
}

TEST(EntryPoses, OfMirrorImagesAreWhatTheyShow) { EXPECT_LT(farthest(gait_pool(gait_takes())), 1e-5); }

TEST(EntryPoses, OfABodyThatIsNotItsOwnMirrorImageAreWhatItShowsToo) {
  FragmentPool pool = gait_pool(gait_takes());
  const int hand = pool.skeleton.roles.left_hand;
  pool.skeleton.offsets[hand] *= 1.3;
  pool.skeleton.tips[pool.skeleton.parents[hand]] *= 1.3;
  EXPECT_LT(farthest(pool), 1e-5);
}

}  // namespace
}  // namespace fragmotion

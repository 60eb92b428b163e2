// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "measured_clips.hpp"
#include "motion/bobbing.hpp"
#include "motion/legs.hpp"

namespace fragmotion {
namespace {

// A body that bends its knees while its feet stand, its hips' heights so many times as far from the first as they go.
Clip bending(double times, double flight = 0) {
  Clip clip = gait_clip({0, 0, 0});
  const Legs legs = find_legs(kKinematics, {gait_clip({})});
  PosedBones posed(kSkeleton.size());
  for (int f = 0; f < clip.frames; ++f) {
    const double down = 0.05 * (1 - std::cos(kPi * f / 15)), first = clip.root_positions[2];
    double* rotations = &clip.rotations[std::size_t{4} * kSkeleton.size() * f];
    world(kKinematics, clip, f, posed.heads.data(), posed.rotations.data());
    for (int leg = 0; leg < legs.count(); ++leg)
      reach(kSkeleton, legs[leg], posed, ankle_of(legs[leg], posed) + down * Vector3::UnitZ(), rotations);
    clip.root_positions[std::size_t{3} * f + 2] = first - times * down + flight * (1 - std::cos(kPi * f / 10));
  }
  return make_clip(kSkeleton, clip);
}

TEST(Bobbing, IsToldByLegs) {
  for (const double times : {1.0, 4.0}) EXPECT_EQ(bobs_too_far(kKinematics, {bending(times)}), 1) << times;
  for (const double times : {10.0, 100.0}) EXPECT_NEAR(bobs_too_far(kKinematics, {bending(times)}), times, times / 20);
}

TEST(Bobbing, IsAsManyTimesAsFarAsLegsGo) {
  for (const double times : {0.25, 1.0, 4.0}) EXPECT_NEAR(bobs(kKinematics, bending(times)), times, times / 20);
  EXPECT_EQ(bobs(kKinematics, bending(1, 1)), 0);
}

TEST(Bobbing, IsRightWhereAnyClipHasItSo) {
  EXPECT_EQ(bobs_too_far(kKinematics, {bending(100), bending(1), bending(100)}), 1);
  EXPECT_EQ(bobs_too_far(kKinematics, {}), 1);
}

TEST(Bobbing, IsNotToldByWhoFlies) { EXPECT_EQ(bobs_too_far(kKinematics, {bending(1, 1)}), 1); }

TEST(Bobbing, IsNotToldWithoutFeet) {
  Skeleton footless = kSkeleton;
  footless.roles.left_foot = footless.roles.right_foot = -1;
  EXPECT_EQ(bobs_too_far(Kinematics(footless), {bending(100)}), 1);
}

}  // namespace
}  // namespace fragmotion

// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "measured_clips.hpp"
#include "motion/stands.hpp"

namespace fragmotion {
namespace {

// The walk with its frames from one on turned so far about the y axis.
Clip walk_turned(double angle, int from = 0) {
  Clip clip = gait_clip({});
  const Quaternion turn{Eigen::AngleAxisd(angle, Vector3::UnitY())};
  for (int f = from; f < clip.frames; ++f) {
    double* hips = &clip.rotations[std::size_t{4} * kSkeleton.size() * f];
    store_quaternion(turn * load_quaternion(hips), hips);
  }
  return make_clip(kSkeleton, clip);
}

TEST(Stands, WhoIsMoreUprightThanLevelInAnyFrame) {
  EXPECT_TRUE(stands(kKinematics, walk_turned(0)));
  EXPECT_TRUE(stands(kKinematics, walk_turned(0.6)));
  EXPECT_TRUE(stands(kKinematics, walk_turned(kPi / 2, 1))) << "in its first frame";
  for (const double angle : {1.0, kPi / 2, kPi, -kPi / 2}) EXPECT_FALSE(stands(kKinematics, walk_turned(angle)));
}

// As blocky figures', whose legs begin beside what carries them.
TEST(Stands, OnLegsOfASingleBone) {
  Skeleton stiff = kSkeleton;
  stiff.roles.left_foot = stiff.roles.left_thigh, stiff.roles.right_foot = stiff.roles.right_thigh;
  stiff.roles.left_toe = stiff.roles.right_toe = -1;
  EXPECT_TRUE(stands(Kinematics(stiff), walk_turned(0)));
  EXPECT_FALSE(stands(Kinematics(stiff), walk_turned(kPi)));
}

TEST(Stands, ABodyWithoutFeet) {
  Skeleton footless = kSkeleton;
  footless.roles.left_foot = footless.roles.right_foot = -1;
  EXPECT_TRUE(stands(Kinematics(footless), walk_turned(kPi)));
}

}  // namespace
}  // namespace fragmotion

// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "motion/cycle.hpp"
#include "walker.hpp"

namespace fragmotion {
namespace {

const Gait kRound{0.3, 1.2, 0.4, 1, 30};  // a second: two steps

double farthest(const Clip& a, const Clip& b, int frames) {
  const Kinematics kinematics(humanoid());
  PosedBones one(kinematics.bones()), other(kinematics.bones());
  double farthest = 0;
  for (int f = 0; f < frames; ++f) {
    world(kinematics, a, f, one.heads.data(), one.rotations.data());
    world(kinematics, b, f, other.heads.data(), other.rotations.data());
    for (int i = 0; i < kinematics.bones(); ++i) farthest = std::max(farthest, (one.heads[i] - other.heads[i]).norm());
  }
  return farthest;
}

TEST(Cycle, IsFoundWithItsLastPoseTwiceOrOnce) {
  const Kinematics kinematics(humanoid());
  const Clip closed = gait_clip(kRound);
  EXPECT_EQ(cycle_of(kinematics, closed), 30);
  EXPECT_EQ(cycle_of(kinematics, part(closed, 0, 29)), 30);
}

// Of motion capture, whose steps are small, no end is as near to the beginning as the next frame.
TEST(Cycle, IsOneAtAnyFrameRate) {
  const Kinematics kinematics(humanoid());
  Gait off = kRound;
  off.seconds = 0.98;
  for (const double rate : {24.0, 30.0, 60.0, 120.0}) {
    off.rate = rate;
    EXPECT_NE(cycle_of(kinematics, gait_clip(off)), 0) << rate;
    off.seconds = 0.9;
    EXPECT_EQ(cycle_of(kinematics, gait_clip(off)), 0) << rate;
    off.seconds = 0.98;
  }
}

TEST(Cycle, IsNoneOfWhatEndsOtherwise) {
  const Kinematics kinematics(humanoid());
  EXPECT_EQ(cycle_of(kinematics, part(gait_clip(kRound), 0, 20)), 0);
  EXPECT_EQ(cycle_of(kinematics, gait_clip({0, 0, 0})), 0);
}

TEST(Cycle, GoesOnAsTheWalkerDoes) {
  const Kinematics kinematics(humanoid());
  Gait longer = kRound;
  longer.seconds = 4;
  const Clip walked = gait_clip(longer), round = gait_clip(kRound);
  EXPECT_LT(farthest(unrolled(kinematics, round, 30, 121), walked, 121), 1e-6);
  EXPECT_LT(farthest(unrolled(kinematics, part(round, 0, 29), 30, 121), walked, 121), 0.02);
}

}  // namespace
}  // namespace fragmotion

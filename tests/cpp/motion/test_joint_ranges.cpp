// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "motion/joint_ranges.hpp"
#include "motion/pose.hpp"
#include "small_character.hpp"

namespace fragmotion {
namespace {

constexpr double kDegree = kPi / 180;
constexpr int kFrames = 41, kBones = 4, kLeg = 2;

// A take of a tiny skeleton whose left leg swings evenly from one angle to another, degrees.
Clip swing(double from, double to) {
  Clip clip{"swing", 20, kFrames, {}, {}, {}};
  for (int f = 0; f < kFrames; ++f) {
    clip.root_positions.insert(clip.root_positions.end(), {0, 0, 1});
    for (int b = 0; b < kBones; ++b) clip.rotations.insert(clip.rotations.end(), {1, 0, 0, 0});
    const double angle = (from + (to - from) * f / (kFrames - 1)) * kDegree;
    store_quaternion(Quaternion{Eigen::AngleAxisd(angle, Vector3::UnitX())},
                     &clip.rotations[std::size_t{4} * (kBones * f + kLeg)]);
  }
  return make_clip(tiny_skeleton(), clip);
}

TEST(JointRanges, TellHowFarAPoseIsBeyondTheTakes) {
  const JointRanges ranges({1, kLeg}, {swing(-20, 10), swing(0, 40)}, 2);
  for (const auto& [angle, beyond] : {std::pair{-35, 15}, {-20, 0}, {15, 0}, {40, 0}, {50, 10}}) {
    EXPECT_NEAR(ranges.excess(swing(angle, angle).rotations.data()), beyond * kDegree, 1e-9) << angle;
  }
}

TEST(JointRanges, TellHowFarATakeIsBeyondTheOthersInTheMean) {
  const std::vector<Clip> takes{swing(-20, 40), swing(-20, 40), swing(0, 70), swing(10, 20)};
  EXPECT_NEAR(JointRanges({kLeg}, takes, 4).usual(), 30 * kDegree / 4, 1e-9);
  std::vector<Clip> mirrored = takes;
  mirrored.insert(mirrored.end(), {swing(0, 0), swing(-50, 0), swing(0, 90), swing(0, 50)});
  EXPECT_NEAR(JointRanges({kLeg}, mirrored, 4).usual(), (30 + 40) * kDegree / 4, 1e-9) << "an image goes with its take";
}

TEST(JointRanges, OfASingleTakeAreNotWhereABodyEnds) {
  EXPECT_EQ(JointRanges({kLeg}, {swing(-20, 40), swing(-40, 20)}, 1).usual(), std::numeric_limits<double>::infinity());
  EXPECT_EQ(JointRanges({}, {swing(-20, 40)}, 1).usual(), 0) << "of no joint";
}

}  // namespace
}  // namespace fragmotion

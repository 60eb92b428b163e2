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
  const JointRanges ranges({1, kLeg}, {swing(-20, 10), swing(0, 40)});
  for (const auto& [angle, beyond] : {std::pair{-35, 15}, {-20, 0}, {15, 0}, {40, 0}, {50, 10}}) {
    EXPECT_NEAR(ranges.excess(swing(angle, angle).rotations.data()), beyond * kDegree, 1e-9) << angle;
  }
}

}  // namespace
}  // namespace fragmotion

// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "evaluate/joint_limits.hpp"
#include "fragments/packed_pool.hpp"
#include "small_character.hpp"

namespace fragmotion {
namespace {

constexpr double kDegree = kPi / 180;
constexpr double kRounding = 0.1 * kDegree;  // of packed clips
constexpr int kFrames = 41, kBones = 4, kLeg = 2;

Quaternion about_x(double angle) { return Quaternion{Eigen::AngleAxisd(angle, Vector3::UnitX())}; }

// A take of a tiny skeleton whose left leg swings evenly from one angle to another, degrees.
Clip swing(double from, double to) {
  Clip clip{"swing", 20, kFrames, {}, {}, {}};
  for (int f = 0; f < kFrames; ++f) {
    clip.root_positions.insert(clip.root_positions.end(), {0, 0, 1});
    for (int b = 0; b < kBones; ++b) clip.rotations.insert(clip.rotations.end(), {1, 0, 0, 0});
    store_quaternion(about_x((from + (to - from) * f / (kFrames - 1)) * kDegree),
                     &clip.rotations[std::size_t{4} * (kBones * f + kLeg)]);
  }
  return make_clip(tiny_skeleton(), clip);
}

// Each clip is a fragment of that origin.
JointLimits limits_of(const std::vector<std::pair<Origin, Clip>>& clips) {
  FragmentPool pool{tiny_skeleton(), {}, {}};
  for (const auto& [origin, clip] : clips) {
    pool.fragments.push_back({static_cast<int>(pool.clips.size()), 0, kFrames - 1, origin, {}});
    pool.clips.push_back(clip);
  }
  return JointLimits(pack(pool));
}

TEST(JointLimits, TellHowFarAJointIsBeyondWhatTheTakesShow) {
  const JointLimits limits = limits_of({{Origin::captured, swing(-20, 40)}});
  EXPECT_EQ(limits.of(swing(-20, 40).rotations).share, 0);
  EXPECT_EQ(limits.of(swing(0, 30).rotations).worst, 0);
  for (const auto& [from, to, beyond] : {std::array{-20, 60, 20}, {-30, 1, 10}, {100, 0, 60}}) {
    const Excess excess = limits.of(swing(from, to).rotations);
    int count = 0;
    for (int f = 0; f < kFrames; ++f) {
      const double angle = from + (to - from) * f / (kFrames - 1.0);
      if (angle < -21 || angle > 41) ++count;
    }
    EXPECT_NEAR(excess.worst, beyond * kDegree, 2 * kRounding) << from << " to " << to;
    EXPECT_NEAR(excess.share, count / (3.0 * kFrames), 1e-9) << from << " to " << to;  // spine and legs
  }
}

TEST(JointLimits, SeeATurnAboutAnAxisThatTheTakesNeverTurnAbout) {
  const JointLimits limits = limits_of({{Origin::captured, swing(-20, 40)}});
  std::vector<double> pose = swing(10, 10).rotations;
  const Quaternion aside{Eigen::AngleAxisd(15 * kDegree, Vector3::UnitY())};
  store_quaternion(about_x(10 * kDegree) * aside, &pose[std::size_t{4} * kLeg]);
  EXPECT_NEAR(limits.of(pose).worst, 15 * kDegree, 2 * kRounding);
}

TEST(JointLimits, AllowMirrorImagesButNotWhatWasSynthesized) {
  const auto worst = [](Origin origin) {
    return limits_of({{Origin::captured, swing(-20, 20)}, {origin, swing(-50, 50)}}).of(swing(0, 50).rotations).worst;
  };
  EXPECT_LT(worst(Origin::mirrored), kRounding);
  EXPECT_NEAR(worst(Origin::interpolated), 30 * kDegree, 2 * kRounding);
  EXPECT_NEAR(worst(Origin::transformed), 30 * kDegree, 2 * kRounding);
}

TEST(JointLimits, MeasureEachTakeByTheOthers) {
  const std::pair<Origin, Clip> narrow{Origin::captured, swing(-20, 20)}, wide{Origin::captured, swing(-40, 40)};
  EXPECT_EQ(limits_of({wide}).takes().worst, 0);
  EXPECT_LT(limits_of({wide, narrow, wide}).takes().worst, kRounding);
  const Excess excess = limits_of({narrow, wide}).takes();
  EXPECT_NEAR(excess.worst, 20 * kDegree, 2 * kRounding);
  int beyond = 0;
  for (int f = 0; f < kFrames; ++f) beyond += std::abs(-40 + 2 * f) > 21 ? 1 : 0;
  EXPECT_NEAR(excess.share, beyond / (2 * 3.0 * kFrames), 1e-9);
}

TEST(JointLimits, LeaveATakesMirrorImageOutWithIt) {
  const Excess excess = limits_of({{Origin::captured, swing(-20, 20)},
                                   {Origin::captured, swing(-40, 40)},
                                   {Origin::mirrored, swing(-20, 20)},
                                   {Origin::mirrored, swing(-40, 40)}})
                            .takes();
  EXPECT_NEAR(excess.worst, 20 * kDegree, 2 * kRounding);
}

TEST(JointLimits, FindNoFaultInTheTakesAndSeeAKneeBentBackward) {
  const auto character = gait_character();
  const PackedPool& pool = character->pool;
  const JointLimits limits(pool);
  for (const Fragment& f : pool.fragments) {
    if (f.origin != Origin::captured && f.origin != Origin::mirrored) continue;
    EXPECT_LT(limits.of(unpack(pool.clips[f.clip]).rotations).worst, kRounding);
  }
  std::vector<double> pose = gait_clip({0, 0, 0}).rotations;
  store_quaternion(about_x(-30 * kDegree), &pose[std::size_t{4} * pool.skeleton.find("shin.L")]);
  EXPECT_GT(limits.of(pose).worst, 30 * kDegree);
}

}  // namespace
}  // namespace fragmotion

// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "control/simulated_players.hpp"
#include "evaluate/motion_metrics.hpp"
#include "motion/trunk.hpp"
#include "runtime/player.hpp"
#include "small_character.hpp"

namespace fragmotion {
namespace {

// A clip's first pose, carried forward at a speed for a second.
Performance carried(const Clip& clip, double speed, double lift = 0) {
  Performance p;
  p.rate = 60;
  p.frames = 61;
  const std::size_t width = clip.rotations.size() / clip.frames;
  for (int f = 0; f < p.frames; ++f) {
    p.root_positions.insert(p.root_positions.end(), {clip.root_positions[0], clip.root_positions[1] + speed * f / 60,
                                                     clip.root_positions[2] + lift});
    p.rotations.insert(p.rotations.end(), clip.rotations.begin(), clip.rotations.begin() + width);
    p.fragments.push_back(0);
    p.entered.push_back(f < 20 ? 0 : 1);
  }
  return p;
}

TEST(MotionMetrics, FindsNoFaultInStanding) {
  const auto character = gait_character();
  const MotionMetrics yardstick(*character);
  const MotionMeasures m = yardstick.of(carried(gait_clip({0, 0, 0}), 0));
  EXPECT_EQ(m.foot_skate, 0);
  EXPECT_EQ(m.sliding_share, 0);
  EXPECT_EQ(m.positions.worst, 0);
  EXPECT_EQ(m.turns.share, 0);
}

TEST(MotionMetrics, SeesFeetThatSlide) {
  const auto character = gait_character();
  const MotionMetrics yardstick(*character);
  const double scale = standard_scale(character->pool.skeleton);
  const Clip standing = gait_clip({0, 0, 0});
  const MotionMeasures slow = yardstick.of(carried(standing, 0.5)), fast = yardstick.of(carried(standing, 1));
  EXPECT_GT(slow.foot_skate, 0);
  EXPECT_LE(slow.foot_skate, 0.5 * scale + 1e-9);
  EXPECT_NEAR(fast.foot_skate, 2 * slow.foot_skate, 1e-9);
  EXPECT_EQ(slow.sliding_share, 1);
  EXPECT_GT(fast.dragged_share, 0.4);
  EXPECT_LE(fast.dragged_share, 1);
  EXPECT_LT(yardstick.takes().dragged_share, fast.dragged_share / 2);  // they repeat: rounding tells the lowest
  EXPECT_NEAR(fast.positions.worst, scale / 60, 1e-6);
  EXPECT_NEAR(fast.velocities.worst, 0, 1e-6);
}

TEST(MotionMetrics, SeesFeetThatTurnOnTheFloor) {
  const auto character = gait_character();
  const MotionMetrics yardstick(*character);
  Performance turning = carried(gait_clip({0, 0, 0}), 0);
  const int hips = character->pool.skeleton.roles.hips, bones = character->pool.skeleton.size();
  EXPECT_EQ(yardstick.of(turning).foot_turn, 0);
  for (int f = 0; f < turning.frames; ++f) {
    turn_bone(character->pool.skeleton, hips, Vector3::UnitZ(), 0.8 * f / turning.rate,
              turning.rotations.data() + std::ptrdiff_t{4} * bones * f);
  }
  EXPECT_NEAR(yardstick.of(turning).foot_turn, 0.8, 1e-6);
}

TEST(MotionMetrics, SeesThatFeetInTheAirDoNotSlideAndThatSunkenOnesPenetrate) {
  const auto character = gait_character();
  const MotionMetrics yardstick(*character);
  const Clip standing = gait_clip({0, 0, 0});
  const MotionMeasures flies = yardstick.of(carried(standing, 1, 1)), sinks = yardstick.of(carried(standing, 0, -0.1));
  EXPECT_EQ(flies.foot_skate, 0);
  EXPECT_EQ(flies.sliding_share, 0);
  EXPECT_NEAR(sinks.penetration, 0.1 * standard_scale(character->pool.skeleton), 0.03);
}

TEST(MotionMetrics, SeesAKneeThatBendsBackward) {
  const auto character = gait_character();
  Clip standing = gait_clip({0, 0, 0});
  const int bones = character->pool.skeleton.size(), shin = character->pool.skeleton.find("shin.L");
  store_quaternion(Quaternion{Eigen::AngleAxisd(-0.5, Vector3::UnitX())}, &standing.rotations[std::size_t{4} * shin]);
  const Excess turns = MotionMetrics(*character).of(carried(standing, 0)).turns;
  EXPECT_GT(turns.worst, 0.5);
  EXPECT_NEAR(turns.share, 1.0 / (bones - 1), 1e-9);  // of all joints but the hips
}

TEST(MotionMetrics, LooksAtStitchesOfAFragmentToItself) {
  const auto character = std::make_shared<const Character>(tiny_character({tiny_clip(1.5)}));
  const Performance p = perform(Player(character), Trace(20, Control{0, 1.5, 0, 0}), 60);
  EXPECT_EQ(p.fragments.front(), p.fragments.back());
  const MotionMetrics yardstick(*character);
  EXPECT_GT(yardstick.of(p).positions.worst, 0.5 * yardstick.takes().positions.worst);
}

TEST(MotionMetrics, MeasuresTheTakes) {
  const MotionMetrics yardstick(*gait_character());
  const MotionMeasures& takes = yardstick.takes();
  EXPECT_GT(takes.foot_skate, 0);
  EXPECT_LT(takes.foot_skate, 0.5);
  EXPECT_LE(takes.positions.p99, takes.positions.p999);
  EXPECT_LE(takes.positions.p999, takes.positions.worst);
}

TEST(MotionMetrics, NeedsCapturedFragments) {
  Character made = *gait_character();
  for (Fragment& f : made.pool.fragments) f.origin = Origin::transformed;
  EXPECT_THROW(MotionMetrics{made}, std::invalid_argument);
}

TEST(MotionMetrics, RefusesPerformancesOfAnotherSkeletonOrOfNothing) {
  const auto other = std::make_shared<const Character>(tiny_character());
  const MotionMetrics yardstick(*gait_character()), others(*other);
  const Performance performance = perform(Player(other), Trace(10, Control{}), 60);
  EXPECT_THROW(yardstick.of(performance), std::invalid_argument);
  EXPECT_THROW(yardstick.of({}), std::invalid_argument);
  EXPECT_NO_THROW(others.of(performance));
}

TEST(MotionMetrics, FindsLessSkateWhereFeetAreLocked) {
  const auto character = gait_character();
  const MotionMetrics yardstick(*character);
  const Trace trace = simulate_trace("walker", 60, 3, character->space);
  PlayerOptions paper;
  paper.stitching = Stitching::crossfade;
  paper.lock_feet = false;
  paper.root_adjustment = 0;
  const double ours = yardstick.of(perform(Player(character), trace, 60)).foot_skate,
               theirs = yardstick.of(perform(Player(character, paper), trace, 60)).foot_skate;
  EXPECT_LT(ours, 0.7 * theirs);
}

}  // namespace
}  // namespace fragmotion

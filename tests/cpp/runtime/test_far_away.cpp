// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>

#include "runtime/crowd.hpp"
#include "small_character.hpp"
#include "steering.hpp"

namespace fragmotion {
namespace {

constexpr double kFarStep = 1.0 / 15, kMoment = 1e-4;  // s

PlayerOptions far_away(std::uint64_t seed = 1) {
  PlayerOptions options;
  options.seed = seed;
  options.far_away = true;
  return options;
}

PlayerOptions without_held_feet() {
  PlayerOptions options;
  options.lock_feet = false;
  return options;
}

Control any_point(Random& random) { return gait_character()->space.point(random.below(kPaperPoints)); }

// Where bones end.
std::vector<Vector3> bone_ends(const Player& player) {
  const Kinematics kinematics(gait_character()->pool.skeleton);
  PosedBones posed(kinematics.bones());
  kinematics.world(player.root_position(), player.rotations().data(), posed.heads.data(), posed.rotations.data());
  for (int b = 0; b < kinematics.bones(); ++b) posed.heads[b] += posed.rotations[b] * kinematics.skeleton().tips[b];
  return posed.heads;
}

double farthest_apart(const std::vector<Vector3>& a, const std::vector<Vector3>& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, (a[i] - b[i]).norm());
  return largest;
}

TEST(FarAway, GoesAsIsAsked) {
  for (const Control& asked : {Control{0, 1.2, 0, 0}, Control{0, 3.3, 0, 0}, Control{1.2, 0, 0, 0}}) {
    Player player(gait_character(), far_away());
    for (int i = 0; i < 30; ++i) player.step(asked, kFarStep);
    Vector3 way = Vector3::Zero();
    for (int i = 0; i < 90; ++i) {
      const CharacterFrame before = player.frame();
      player.step(asked, kFarStep);
      way += before.to_local({player.frame().position.x(), player.frame().position.y(), 0});
    }
    EXPECT_NEAR(way.x() / 6, asked.x, 0.2) << asked.x;
    EXPECT_NEAR(way.y() / 6, asked.y, 0.3) << asked.y;
  }
}

TEST(FarAway, TurnsAsIsAsked) {
  Player player(gait_character(), far_away());
  for (int i = 0; i < 60; ++i) player.step({0, 1.2, 1, 0}, kFarStep);
  EXPECT_NEAR(player.frame().heading, 4 * gait_character()->space.turn_rate(), 0.5);
}

TEST(FarAway, JumpsWhenIsAsked) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    Player player(gait_character(), far_away(seed));
    for (int i = 0; i < 20; ++i) player.step(kForward, kFarStep);
    player.step({0, 1.2, 0, 1}, kFarStep);
    bool jumps = false;
    for (int i = 0; i < 15; ++i) {
      jumps = jumps || player.playback().evident().jumps();
      player.step(kForward, kFarStep);
    }
    EXPECT_TRUE(jumps) << seed;
  }
}

TEST(FarAway, PlaysFragmentsToTheirEnds) {
  Player player(gait_character(), far_away());
  Random random(3);
  for (int i = 0; i < 1000; ++i) {
    const bool ends = player.seconds_left() < 2 * kFarStep;
    const int entered = player.entered();
    player.step(any_point(random), kFarStep);
    ASSERT_TRUE(ends || player.entered() == entered) << i;
  }
}

// However the level of detail changes, and within whatever stitch.
TEST(FarAway, IsShownTheSameWhereItComesNearAndGoes) {
  Player player(gait_character(), without_held_feet());
  Random random(5);
  bool near = true;
  for (int i = 0; i < 600; ++i) {
    const Control control = any_point(random);
    for (int k = random.below(12); k >= 0; --k) player.step(control, near ? kStep : kFarStep);
    player.step(control, kMoment);
    const std::vector<Vector3> before = bone_ends(player);
    near = !near;
    player.set_options(near ? without_held_feet() : far_away());
    player.step(control, kMoment);
    ASSERT_LT(farthest_apart(bone_ends(player), before), 0.01) << i;
  }
}

// What a crowd in so many parts shows at last.
std::vector<double> shown_far_away(int parts) {
  constexpr int kCount = 20;
  Crowd crowd(gait_character(), kCount, far_away(), parts);
  Random random(9);
  std::vector<double> rotations(4 * kCount * std::size_t(crowd.bones()));
  for (int i = 0; i < 200; ++i) {
    std::vector<Control> controls;
    for (int player = 0; player < kCount; ++player) controls.push_back(any_point(random));
    for (int part = crowd.parts() - 1; part >= 0; --part)
      crowd.step_part(part, controls.data(), kFarStep, nullptr, rotations.data());
  }
  return rotations;
}

TEST(FarAway, IsShownTheSameWhateverTheParts) { EXPECT_EQ(shown_far_away(1), shown_far_away(7)); }

}  // namespace
}  // namespace fragmotion

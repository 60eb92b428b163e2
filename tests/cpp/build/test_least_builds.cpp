// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <memory>
#include <string>

#include "build/build.hpp"
#include "character/character.hpp"
#include "character/policy_file.hpp"
#include "control/simulated_players.hpp"
#include "evaluate/performance.hpp"
#include "policy/optimal.hpp"
#include "runtime/player.hpp"
#include "small_build.hpp"
#include "small_character.hpp"

namespace fragmotion {
namespace {

TEST(Build, HasNoMoreClassesThanDistinctFragments) {
  BuildOptions options = few_classes();
  options.synthesize = options.mirror = false;
  options.classes = 2;
  const Clip still = some_takes()[0];  // every part of it is the same
  EXPECT_EQ(build(humanoid(), {still, still}, some_traces(), options).classes.count, 1);
  options = few_classes();
  options.classes = 5000;
  const Character all = build(humanoid(), some_takes(), some_traces(), options);
  EXPECT_GT(all.classes.count, 2);
  EXPECT_LE(all.classes.count, static_cast<int>(all.pool.fragments.size()));
}

TEST(Build, LearnsFromATraceOfOneControl) {
  BuildOptions options = few_classes();
  options.policies = policy_names();
  const Control forward{0, 1.2, 0, 0};
  std::map<std::string, double> mean;
  for (options.seed = 1; options.seed <= 4; ++options.seed) {
    const auto c = std::make_shared<const Character>(build(humanoid(), some_takes(), {Trace(50, forward)}, options));
    for (const std::string& policy : policy_names()) {
      const double percent = percent_of_optimal(c->quality, c->policy(policy), snap(c->space, Trace(50, forward)));
      EXPECT_LE(percent, 100 + 1e-9) << policy;
      mean[policy] += percent / 4;
    }
  }
  for (const std::string& policy : policy_names()) EXPECT_GT(mean[policy], 80) << policy;
}

TEST(Build, StandsWhereTheTakesCanDoNothingElse) {
  BuildOptions options = few_classes();
  options.policies = policy_names();
  for (const bool synthesize : {true, false}) {
    options.synthesize = synthesize;
    options.classes = synthesize ? 3 : 1;
    const auto c = std::make_shared<const Character>(build(humanoid(), {some_takes()[0]}, some_traces(), options));
    for (const std::string& policy : policy_names()) {
      PlayerOptions options;
      options.policy = policy;
      Player player(c, options);
      for (int i = 0; i < 300; ++i) player.step({0, 3, 0, 0}, 1.0 / 30);
      EXPECT_LT(player.root_position().head<2>().norm(), 1) << policy;
    }
  }
}

TEST(Build, MakesOneClass) {
  BuildOptions options = few_classes();
  options.policies = policy_names();
  options.classes = 1;
  const auto c = std::make_shared<const Character>(build(humanoid(), some_takes(), some_traces(), options));
  const std::vector<int> trace = snap(c->space, some_traces()[0]);
  for (const std::string& policy : policy_names())
    EXPECT_NEAR(percent_of_optimal(c->quality, c->policy(policy), trace), 100, 1e-9) << policy;
  Player player(c);
  for (int i = 0; i < 100; ++i) player.step({0, 3, 0, 0}, 1.0 / 30);
  EXPECT_TRUE(player.root_position().allFinite());
}

TEST(Build, TakesASkeletonOfOneBone) {
  Skeleton bone;
  bone.names = {"bone"};
  bone.parents = {-1};
  bone.rest_rotations = {Quaternion::Identity()};
  bone.offsets = {{0, 0, 0}};
  bone.tips = {{0, 0, 1}};
  bone = make_skeleton(bone);
  Clip clip{"slide", 30, 91, {}, {}, {}};
  for (int f = 0; f < clip.frames; ++f) {
    clip.root_positions.insert(clip.root_positions.end(), {0, -f / 30.0, 0.01 * std::sin(0.2 * f)});
    clip.rotations.insert(clip.rotations.end(), {1, 0, 0, 0});
  }
  BuildOptions options = few_classes();
  options.classes = 3;
  const auto c = std::make_shared<const Character>(build(bone, {make_clip(bone, clip)}, some_traces(), options));
  EXPECT_EQ(c->classes.count, 3);
  Player player(c);
  for (int i = 0; i < 60; ++i) player.step({0, 1, 0, 0}, 1.0 / 30);
  EXPECT_GT(player.root_position().head<2>().norm(), 0.7);  // it slides at 1 m/s once it does
}

// Plays a character that has no legs to lock, with and without the lock; returns the frames that differ.
int frames_that_a_foot_lock_moves(const std::shared_ptr<const Character>& c) {
  PlayerOptions free;
  free.lock_feet = false;
  Player locked(c), unlocked(c, free);
  const Trace trace = simulate_trace("explorer", 10, 4, c->space);
  const Performance a = perform(locked, trace, 30), b = perform(unlocked, trace, 30);
  const std::size_t width = a.rotations.size() / a.frames;
  int moved = 0;
  for (int f = 0; f < a.frames; ++f) {
    const auto same = [&](const std::vector<double>& one, const std::vector<double>& other, std::size_t n) {
      return std::equal(one.begin() + n * f, one.begin() + n * (f + 1), other.begin() + n * f);
    };
    moved += same(a.rotations, b.rotations, width) && same(a.root_positions, b.root_positions, 3) ? 0 : 1;
  }
  return moved;
}

TEST(Build, TakesARigWithoutKneesAndLocksNoFeet) {
  for (const bool root : {false, true}) {
    const Skeleton skeleton = kneeless_skeleton(root);
    const std::vector<Clip> clips{kneeless_clip(skeleton, 0), kneeless_clip(skeleton, 1)};
    const auto make = [&] { return build(skeleton, clips, some_traces(), few_classes()); };
    const std::string bytes = to_bytes(make());
    EXPECT_EQ(to_bytes(make()), bytes) << root;
    const auto c = std::make_shared<const Character>(from_bytes(bytes));
    EXPECT_FALSE(c->contacts[0].feet[0].empty()) << root;
    EXPECT_EQ(frames_that_a_foot_lock_moves(c), 0) << root;
  }
}

TEST(Build, GivesTheSameBitsWhereASkeletonHasOneLeg) {
  for (const char* side : {".L", ".R"}) {
    Skeleton skeleton = humanoid();
    for (const char* bone : {"thigh", "shin", "foot"}) {  // neither called nor shaped like a leg
      const int peg = skeleton.find(std::string(bone) + side);
      skeleton.names[peg] = "peg " + std::to_string(peg);
      skeleton.offsets[peg] *= 0.05;
      skeleton.tips[peg] *= 0.05;
    }
    skeleton.roles = {};
    const auto make = [&] { return to_bytes(build(skeleton, some_takes(), some_traces(), few_classes())); };
    const std::string bytes = make();
    EXPECT_EQ(make(), bytes) << side;
    for (const Leg& leg : from_bytes(bytes).legs) {
      EXPECT_FALSE(leg.exists()) << side;
      EXPECT_EQ(leg.hinge, Leg().hinge) << side;
    }
  }
}

TEST(Build, TakesASkeletonWithoutFeet) {
  Skeleton legless = humanoid();
  legless.roles.left_foot = legless.roles.right_foot = -1;
  const Character c = build(legless, some_takes(), some_traces(), few_classes());
  EXPECT_EQ(c.classes.count, 15);
}

}  // namespace
}  // namespace fragmotion

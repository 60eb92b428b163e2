// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "build/build.hpp"
#include "character/character.hpp"
#include "character/policy_file.hpp"
#include "control/simulated_players.hpp"
#include "fragments/hips_velocity.hpp"
#include "mocap_files.hpp"
#include "on_slope.hpp"
#include "policy/greedy.hpp"
#include "small_build.hpp"
#include "small_character.hpp"

namespace fragmotion {
namespace {

TEST(Build, HoldsWhatItsReportSays) {
  const Character& c = *gait_character();
  EXPECT_EQ(c.report.at("fragments"), static_cast<double>(c.pool.fragments.size()));
  EXPECT_EQ(c.report.at("classes"), c.classes.count);
  const auto captured = std::count_if(c.pool.fragments.begin(), c.pool.fragments.end(), [](const Fragment& f) {
    return f.origin == Origin::captured || f.origin == Origin::mirrored;
  });
  EXPECT_EQ(c.report.at("captured"), static_cast<double>(captured));
  EXPECT_EQ(c.policy().next.size(), std::size_t{40} * kPaperPoints);
  EXPECT_EQ(c.bridges.size(), std::size_t{40} * 40);
  for (const auto& [name, value] : c.report) EXPECT_TRUE(std::isfinite(value) && value >= 0) << name;
}

TEST(Build, FindsTheGaitsOfItsTakes) {
  const ControlSpace& space = gait_character()->space;
  EXPECT_NEAR(space.walk(), 1.2, 0.15);
  EXPECT_NEAR(space.run(), 3, 0.3);
}

TEST(Build, GivesTheSameBitsForAnyNumberOfThreads) {
  for (const std::string& policy : policy_names()) {
    BuildOptions options = few_classes(policy);
    options.threads = 1;
    const std::string one = to_bytes(build(humanoid(), some_takes(), some_traces(), options));
    for (const int threads : {1, 2, 3}) {
      options.threads = threads;
      EXPECT_EQ(to_bytes(build(humanoid(), some_takes(), some_traces(), options)), one) << policy;
    }
  }
}

TEST(Build, TakesNoJumpForAWayThatTheBodyWent) {
  std::vector<Clip> takes = some_takes();
  Clip& stand = takes[0];
  for (int f = stand.frames / 2; f < stand.frames; ++f) stand.root_positions[std::size_t{3} * f] += 2;
  const Character c = build(humanoid(), takes, some_traces(), few_classes());
  for (int f = 0; f < stand.frames; ++f) EXPECT_LT(hips_velocity_around(c.pool.clips[0], f, 0.5).norm(), 0.1) << f;
}

TEST(Build, NamesItsPolicyAndFillsTheTableWithClasses) {
  for (const std::string& policy : policy_names()) {
    Character c = build(humanoid(), some_takes(), some_traces(), few_classes(policy));
    EXPECT_EQ(c.policy().name, policy);
    for (const int next : c.policy().next) ASSERT_TRUE(next >= 0 && next < 15);
    if (policy == "greedy") {
      const std::vector<int> next = c.policy().next;
      c.policies = {greedy_policy(c.quality)};
      repair_policies(c);
      EXPECT_EQ(next, c.policy().next);
    }
  }
}

TEST(Build, TheFirstPolicyAskedForDrives) {
  BuildOptions options = few_classes();
  options.policies = {"iterate", "greedy"};
  const Character c = build(humanoid(), some_takes(), some_traces(), options);
  ASSERT_EQ(c.policies.size(), 2U);
  EXPECT_EQ(c.policy().name, "iterate");
  EXPECT_EQ(&c.policy("greedy"), &c.policies[1]);
  const std::string error = error_of([&] { static_cast<void>(c.policy("svm")); });
  for (const char* part : {"\"svm\"", "iterate", "greedy"}) EXPECT_NE(error.find(part), std::string::npos) << error;
  options.policies = {};
  EXPECT_NE(error_of([&] { build(humanoid(), some_takes(), some_traces(), options); }), "no error");
}

TEST(Build, MirrorsAndSynthesizesOnlyWhenAsked) {
  BuildOptions options = few_classes();
  const std::size_t all = build(humanoid(), some_takes(), some_traces(), options).pool.fragments.size();
  options.synthesize = false;
  const Character mirrored = build(humanoid(), some_takes(), some_traces(), options);
  options.mirror = false;
  const Character plain = build(humanoid(), some_takes(), some_traces(), options);
  EXPECT_LT(plain.pool.fragments.size(), mirrored.pool.fragments.size());
  EXPECT_LT(mirrored.pool.fragments.size(), all);
  for (const Fragment& f : plain.pool.fragments) EXPECT_EQ(f.origin, Origin::captured);
  EXPECT_EQ(plain.pool.clips.size(), 4U);
}

TEST(Build, IsTheSameCharacterTenTimesAsLarge) {
  BuildOptions options = few_classes();
  const Character usual = build(humanoid(), gait_takes(), some_traces(), options),
                  giant = build(humanoid(10), gait_takes(30, 10), some_traces(), options);
  ASSERT_EQ(giant.pool.fragments.size(), usual.pool.fragments.size());
  EXPECT_NEAR(giant.space.walk(), 10 * usual.space.walk(), 1e-3);
  EXPECT_NEAR(giant.space.run(), 10 * usual.space.run(), 1e-3);
  for (std::size_t i = 0; i < usual.pool.fragments.size(); ++i) {
    EXPECT_NEAR(giant.pool.fragments[i].evident.y, 10 * usual.pool.fragments[i].evident.y, 1e-2) << i;
    EXPECT_NEAR(giant.pool.fragments[i].evident.turn, usual.pool.fragments[i].evident.turn, 1e-2) << i;
  }
  ASSERT_EQ(giant.entry_poses.size(), usual.entry_poses.size());
  for (std::size_t i = 0; i < usual.entry_poses.size(); ++i) {
    EXPECT_NEAR(giant.entry_poses[i], usual.entry_poses[i], 0.01)
        << "of fragment " << i / (usual.entry_poses.size() / usual.pool.fragments.size());
  }
}

// Whose takes were captured otherwise, so that one fragment may be entered a frame earlier or later.
void expect_same_character(const std::vector<Clip>& takes, const std::vector<Clip>& usual, double same) {
  const Character character = build(humanoid(), takes, some_traces(), few_classes()),
                  expected = build(humanoid(), usual, some_traces(), few_classes());
  ASSERT_EQ(character.entry_poses.size(), expected.entry_poses.size());
  const std::size_t each = expected.entry_poses.size() / expected.pool.fragments.size();
  int otherwise = 0;
  for (std::size_t f = 0; f < expected.pool.fragments.size(); ++f) {
    const int first = character.pool.fragments[f].first_played(), usually = expected.pool.fragments[f].first_played();
    EXPECT_NEAR(first, usually, 1);
    otherwise += first != usually ? 1 : 0;
    for (std::size_t i = each * f; first == usually && i < each * (f + 1); ++i)
      EXPECT_NEAR(character.entry_poses[i], expected.entry_poses[i], same);
  }
  EXPECT_LE(otherwise, 1);
}

TEST(Build, IsTheSameCharacterOfATakeThatWasCapturedHigher) {
  std::vector<Clip> takes = some_takes();
  for (std::size_t z = 2; z < takes[1].root_positions.size(); z += 3) takes[1].root_positions[z] += 0.03;
  expect_same_character(takes, some_takes(), 0.01);
}

// But for a step that is cut a frame earlier. As it was captured it would have other fragments.
TEST(Build, IsTheSameCharacterOfAWalkThatWasCapturedOnAFloorThatRises) {
  std::vector<Clip> takes = some_takes();
  takes[1] = on_slope({0, 0.02}, takes[1]);
  expect_same_character(takes, some_takes(), 0.05);
}

TEST(Build, HasClassesForHopsOnTheSpotAndAhead) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    BuildOptions options;
    options.classes = 50;
    options.seed = seed;
    options.policies = {"greedy"};
    const Character c = build(humanoid(), gait_takes(), some_traces(), options);
    for (const double speed : {0.0, c.space.walk(), c.space.run()}) {
      double least = 9;
      for (const int fragment : c.classes.representatives) {
        least = std::min(least, c.space.distance(c.pool.fragments[fragment].evident, {0, speed, 0, 1}));
      }
      EXPECT_LT(least, 1) << "hopping at " << speed << " m/s, seed " << seed;
    }
  }
}

TEST(Build, TakesRawClipsAndARawSkeleton) {
  const Character made = build(humanoid(), some_takes(), some_traces(), few_classes());
  std::vector<Clip> raw = some_takes();
  for (Clip& clip : raw) {
    clip.headings.clear();
    for (std::size_t i = 0; i < clip.rotations.size(); ++i) clip.rotations[i] *= i / 4 % 2 == 0 ? 2 : -1;
  }
  Skeleton skeleton = humanoid();
  skeleton.roles = {};
  const Character c = build(skeleton, raw, some_traces(), few_classes());
  ASSERT_EQ(c.pool.fragments.size(), made.pool.fragments.size());
  for (std::size_t i = 0; i < c.pool.fragments.size(); ++i)
    EXPECT_LT(c.space.distance(c.pool.fragments[i].evident, made.pool.fragments[i].evident), 1e-6);
  raw[2].rotations.pop_back();
  EXPECT_NE(error_of([&] { build(skeleton, raw, some_traces(), few_classes()); }).find("run"), std::string::npos);
}

TEST(Build, BuildsAtTheEndsOfTheRangesWhatCanBeSaved) {
  for (const double longest : {0.1, 10.0}) {
    for (const double rate : {10.0, 30.0}) {
      BuildOptions options = few_classes();
      options.cut.shortest = 0.1;
      options.cut.longest = longest;
      options.classes = 3;
      const std::vector<Clip> all = gait_takes(rate);
      const std::string bytes = to_bytes(build(humanoid(), {all[0], all[1]}, some_traces(), options));
      EXPECT_EQ(to_bytes(from_bytes(bytes)), bytes) << longest;
    }
  }
}

TEST(Build, TellsItsProgressInOrder) {
  std::vector<double> fractions;
  std::vector<std::string> stages;
  build(humanoid(), some_takes(), some_traces(), few_classes("svm"), [&](double fraction, const std::string& stage) {
    fractions.push_back(fraction);
    stages.push_back(stage);
    return true;
  });
  ASSERT_GT(fractions.size(), 4U);
  EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()));
  EXPECT_GE(fractions.front(), 0);
  EXPECT_EQ(fractions.back(), 1);
  for (const std::string& stage : stages) EXPECT_FALSE(stage.empty());
}

TEST(Build, IsCancelledAtEveryReport) {
  int reports = 0;
  const BuildOptions options = few_classes("svm");
  build(humanoid(), some_takes(), some_traces(), options, [&](double, const std::string&) { return ++reports > 0; });
  for (int stop = 1; stop <= reports; ++stop) {
    int calls = 0;
    EXPECT_THROW(build(humanoid(), some_takes(), some_traces(), options,
                       [&](double, const std::string&) { return ++calls < stop; }),
                 Cancelled);
    EXPECT_EQ(calls, stop);
  }
}

// A policy file is repaired when it is read, and is to be what was saved.
TEST(Build, RepairsItsTablesForGood) {
  for (const int classes : {8, 12, 20, 33}) {
    BuildOptions options;
    options.classes = classes;
    Character c = build(humanoid(), gait_takes(), {simulate_trace("explorer", 5, classes, ControlSpace())}, options);
    const std::vector<Policy> before = c.policies;
    repair_policies(c);
    for (std::size_t p = 0; p < before.size(); ++p) {
      EXPECT_EQ(c.policies[p].next, before[p].next) << before[p].name << " of " << classes << " classes";
    }
  }
}

}  // namespace
}  // namespace fragmotion

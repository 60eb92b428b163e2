// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "build/build.hpp"
#include "character/character.hpp"
#include "character/policy_file.hpp"
#include "control/simulated_players.hpp"
#include "evaluate/performance.hpp"
#include "mocap_files.hpp"
#include "policy/greedy.hpp"
#include "policy/optimal.hpp"
#include "runtime/player.hpp"
#include "skeleton/roles.hpp"
#include "small_character.hpp"
#include "small_skeleton.hpp"

namespace fragmotion {
namespace {

std::vector<Trace> some_traces() { return {simulate_trace("explorer", 20, 1, ControlSpace())}; }

BuildOptions few_classes(const std::string& policy = "greedy") {
  BuildOptions options;
  options.classes = 15;
  options.policies = {policy};
  return options;
}

std::vector<Clip> some_takes() {
  const std::vector<Clip> all = gait_takes();
  return {all[0], all[1], all[9], all[10]};
}

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

TEST(Build, IsTheSameCharacterOfATakeThatWasCapturedHigher) {
  std::vector<Clip> takes = some_takes();
  const Character level = build(humanoid(), takes, some_traces(), few_classes());
  for (std::size_t z = 2; z < takes[1].root_positions.size(); z += 3) takes[1].root_positions[z] += 0.03;
  const Character high = build(humanoid(), takes, some_traces(), few_classes());
  ASSERT_EQ(high.entry_poses.size(), level.entry_poses.size());
  for (std::size_t i = 0; i < level.entry_poses.size(); ++i)
    EXPECT_NEAR(high.entry_poses[i], level.entry_poses[i], 0.01);
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

TEST(Build, RefusesWhatItCannotBuildFrom) {
  const std::vector<Clip> takes = some_takes();
  const auto error = [&](const std::vector<Clip>& clips, const std::vector<Trace>& traces,
                         const BuildOptions& options) {
    return error_of([&] { build(humanoid(), clips, traces, options); });
  };
  const auto expect = [](const std::string& error, const std::string& part) {
    EXPECT_NE(error.find(part), std::string::npos) << error;
  };
  expect(error({}, some_traces(), few_classes()), "no takes");
  expect(error(takes, {}, few_classes()), "no trace");
  expect(error(takes, {{}}, few_classes()), "two controls");
  expect(error(takes, {Trace(1)}, few_classes()), "two controls");
  expect(error(takes, some_traces(), few_classes("wise")), "\"wise\"");
  BuildOptions options = few_classes();
  options.classes = 0;
  expect(error(takes, some_traces(), options), "classes");
  options = few_classes();
  options.cut.shortest = 2;
  expect(error(takes, some_traces(), options), "\"stand\"");
  Gait blink;
  blink.seconds = 0.05;
  expect(error({gait_clip(blink)}, some_traces(), few_classes()), "too short");
}

TEST(Build, RefusesClipsOfAnotherSkeletonNamingThem) {
  const Skeleton other = small_skeleton();
  Clip stranger = make_clip(other, random_clip(other, 60, 1));
  stranger.name = "stranger";
  std::vector<Clip> clips = some_takes();
  clips.push_back(stranger);
  const std::string error = error_of([&] { build(humanoid(), clips, some_traces(), few_classes()); });
  EXPECT_NE(error.find("stranger"), std::string::npos) << error;
}

TEST(Build, RefusesClipsThatAreNotFiniteNamingThem) {
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    for (auto values : {&Clip::root_positions, &Clip::rotations, &Clip::headings}) {
      std::vector<Clip> clips = some_takes();
      (clips[1].*values)[5] = bad;
      clips[1].name = "broken";
      const std::string error = error_of([&] { build(humanoid(), clips, some_traces(), few_classes()); });
      EXPECT_NE(error.find("'broken'"), std::string::npos) << error;
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

TEST(Build, RefusesOptionsOutOfTheirRangesBeforeItBegins) {
  const auto error = [](const std::function<void(BuildOptions&)>& spoil) {
    BuildOptions options = few_classes();
    spoil(options);
    const Progress none = [](double, const std::string& stage) {
      ADD_FAILURE() << stage;
      return false;
    };
    return error_of([&] { build(humanoid(), some_takes(), some_traces(), options, none); });
  };
  for (const double bad : {-0.1, 0.0, 0.01, 11.0, 1e8, 1e308, std::nan(""), double(INFINITY), -double(INFINITY)}) {
    EXPECT_NE(error([=](BuildOptions& o) { o.cut.shortest = bad; }).find("shortest fragment"), std::string::npos)
        << bad;
    EXPECT_NE(error([=](BuildOptions& o) { o.cut.longest = bad; }).find("longest fragment"), std::string::npos) << bad;
  }
  for (const int bad : {-1, 0, 10001, 0x7fffffff}) {
    EXPECT_NE(error([=](BuildOptions& o) { o.classes = bad; }).find("classes must be 1 to 10000"), std::string::npos);
  }
  EXPECT_NE(error([](BuildOptions& o) { o.restarts = 10001; }).find("restarts must be"), std::string::npos);
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

TEST(Build, RefusesWhatCouldNotBeSavedNamingTheClipAndTheLimit) {
  const auto error = [](const std::function<void(Clip&)>& spoil) {
    std::vector<Clip> takes = some_takes();
    takes[1].name = "far";
    spoil(takes[1]);
    return error_of([&] { build(humanoid(), takes, some_traces(), few_classes()); });
  };
  const std::string fast = error([](Clip& c) { c.rate = 1e9; });
  EXPECT_NE(fast.find("'far'"), std::string::npos) << fast;
  EXPECT_NE(fast.find("to 10000"), std::string::npos) << fast;
  const std::string far = error([](Clip& c) { c.root_positions[30] = 1e12; });
  EXPECT_NE(far.find("'far'"), std::string::npos) << far;
  EXPECT_NE(far.find("1000 km"), std::string::npos) << far;
  Skeleton flat = humanoid(1e-5);
  EXPECT_NE(error_of([&] { build(flat, some_takes(), some_traces(), few_classes()); }).find("1 mm"), std::string::npos);
}

TEST(Build, RefusesTracesThatAreNotFiniteNamingTheControl) {
  Trace trace(5);
  trace[3].turn = std::numeric_limits<double>::quiet_NaN();
  const std::string error = error_of([&] { build(humanoid(), some_takes(), {Trace(5), trace}, few_classes()); });
  EXPECT_NE(error.find("control 3 of trace 1"), std::string::npos) << error;
}

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
  const auto c = std::make_shared<const Character>(build(humanoid(), some_takes(), {Trace(50, forward)}, options));
  for (const std::string& policy : policy_names()) {
    const double percent = percent_of_optimal(c->quality, c->policy(policy), snap(c->space, Trace(50, forward)));
    EXPECT_GT(percent, 80) << policy;
    EXPECT_LE(percent, 100 + 1e-9) << policy;
  }
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

TEST(ControlSpaceOf, FindsTwoGaits) {
  Random random(1);
  std::vector<Control> evident;
  for (int i = 0; i < 200; ++i) {
    const double angle = 2 * kPi * random.uniform(), speed = i % 2 == 0 ? 1.4 : 4.2;
    evident.push_back({speed * std::cos(angle), speed * std::sin(angle), 0, 0});
  }
  for (const double size : {1.0, 10.0}) {
    std::vector<Control> sized = evident;
    for (Control& c : sized) c.x *= size, c.y *= size;
    const ControlSpace space = control_space_of(sized, 1 / size);
    EXPECT_NEAR(space.walk(), 1.4 * size, 1e-9 * size);
    EXPECT_NEAR(space.run(), 4.2 * size, 1e-9 * size);
    EXPECT_NEAR(space.scale(), 1 / size, 1e-12);
  }
}

TEST(ControlSpaceOf, KeepsTheDefaultsWhereNothingMoves) {
  const ControlSpace standard, space = control_space_of(std::vector<Control>(20), 1);
  EXPECT_NEAR(space.walk(), standard.walk(), 1e-12);
  EXPECT_NEAR(space.run(), standard.run(), 1e-12);
  EXPECT_NEAR(space.turn_rate(), standard.turn_rate(), 1e-12);
}

TEST(ControlSpaceOf, IsASpaceForAnyFragments) {
  Random random(2);
  for (int n = 0; n < 300; ++n) {
    std::vector<Control> evident(1 + random.below(30));
    const double size = 10 * random.uniform() * random.uniform();
    for (Control& c : evident)
      c = {size * (random.uniform() - 0.5), size * (random.uniform() - 0.5), 3 * random.uniform() - 1.5,
           random.uniform()};
    const ControlSpace space = control_space_of(evident, 1);
    EXPECT_GT(space.walk(), 0);
    EXPECT_GT(space.run(), space.walk());
    EXPECT_GT(space.turn_rate(), 0);
  }
}

TEST(Snap, FindsTheNearestPointOfEveryControl) {
  const ControlSpace space;
  const Trace trace = simulate_trace("twitcher", 5, 3, space);
  const std::vector<int> indices = snap(space, trace);
  ASSERT_EQ(indices.size(), trace.size());
  for (std::size_t i = 0; i < trace.size(); ++i) EXPECT_EQ(indices[i], space.nearest(trace[i]));
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

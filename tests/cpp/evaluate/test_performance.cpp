// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "build/build.hpp"
#include "control/simulated_players.hpp"
#include "evaluate/performance.hpp"
#include "fragments/entry_poses.hpp"
#include "runtime/player.hpp"
#include "small_character.hpp"

namespace fragmotion {
namespace {

constexpr double kRate = 60;
const Control kForward{0, 1.2, 0, 0};

TEST(OptimalPerformance, IsNeverReachedByAPlayer) {
  const auto character = gait_character();
  for (const std::string& name : simulated_players()) {
    const Trace trace = simulate_trace(name, 30, 5, character->space);
    const double best = optimal_performance(*character, trace, kRate, kEntry);
    EXPECT_LT(best, 1);
    for (const std::uint64_t seed : {1, 2, 3}) {
      const double reached = perform(Player(character, {seed}), trace, kRate).quality;
      EXPECT_LE(reached, best) << name;
      EXPECT_GT(reached, 0.3 * best) << name;
    }
  }
}

// All plays of the tiny character's two classes, frame by frame.
double brute_force(const Character& c, const std::vector<int>& controls, int f, int from, const int* shortest,
                   const int* longest) {
  const int frames = static_cast<int>(controls.size());
  if (f == frames) return 0;
  double best = 0;
  for (int to = 0; to < 2; ++to) {
    double sum = 0;
    for (int end = f + 1; end <= std::min(frames, f + longest[to]); ++end) {
      sum += c.quality(from, to, controls[end - 1]);
      if (end < frames && end - f < shortest[to]) continue;
      best = std::max(best, sum + brute_force(c, controls, end, to, shortest, longest));
    }
  }
  return best;
}

TEST(OptimalPerformance, IsTheBestOfAllPlays) {
  const Character c = tiny_character();
  constexpr double kFew = 20;  // frames a second
  int shortest[2] = {3, 3}, longest[2] = {0, 0};
  for (std::size_t f = 0; f < c.pool.fragments.size(); ++f) {
    const int frames = static_cast<int>(std::lround(c.pool.seconds(c.pool.fragments[f]) * kFew)),
              k = c.classes.labels[f];
    shortest[k] = std::min(shortest[k], frames);
    longest[k] = std::max(longest[k], frames);
  }
  Random random(4);
  for (int n = 0; n < 10; ++n) {
    Trace trace;
    std::vector<int> controls;
    for (int i = 0; i < 7; ++i) {
      const int control = random.below(kPaperPoints);
      trace.push_back(c.space.point(control));
      controls.insert(controls.end(), 2, c.space.nearest(c.admitted(c.space.point(control))));
    }
    const double expected =
        std::max(brute_force(c, controls, 0, 0, shortest, longest), brute_force(c, controls, 0, 1, shortest, longest));
    EXPECT_NEAR(optimal_performance(c, trace, kFew, 0.15) * 14, expected, 1e-9);
  }
}

TEST(OptimalPerformance, RefusesAnEmptyTraceAndARateOfNothing) {
  const Character c = tiny_character();
  EXPECT_THROW(optimal_performance(c, {}, kRate, kEntry), std::invalid_argument);
  EXPECT_THROW(optimal_performance(c, {{}, {}}, 0, kStitch), std::invalid_argument);
  EXPECT_THROW(optimal_performance(c, {{}, {}}, 1e-9, kStitch), std::invalid_argument);
}

TEST(OptimalPerformance, RefusesAShortestTimeThatIsNone) {
  const Character c = tiny_character();
  for (const double shortest : {std::nan(""), -1.0, 1e308, static_cast<double>(INFINITY)}) {
    EXPECT_THROW(optimal_performance(c, {{}, {}}, kRate, shortest), std::invalid_argument) << shortest;
  }
}

TEST(FrameCount, IsRoundedAndHasAnEnd) {
  EXPECT_EQ(frame_count(20, 30), 61);
  EXPECT_EQ(frame_count(7, 29.97), 22);
  EXPECT_EQ(frame_count(10 * (kMostFrames - 1), 1), kMostFrames);
  EXPECT_THROW(frame_count(10 * std::size_t{kMostFrames}, 1), std::invalid_argument);
  EXPECT_THROW(frame_count(std::size_t{1} << 40, 1000), std::invalid_argument);
}

TEST(Judge, MeasuresAPathAgainstItsTrace) {
  const Character c = tiny_character();
  Performance p;
  p.rate = kRate;
  p.frames = 121;
  for (int f = 0; f < p.frames; ++f) {  // turns left at 0.5 rad/s in place, and is carried forward and to the right
    const double heading = 0.5 * f / kRate, forward = 1.5 * f / kRate;
    p.path.insert(p.path.end(), {0.2 * f / kRate, forward, heading});
    p.fragments.push_back(0);
  }
  judge(p, c, Trace(20, Control{0, 1, 1, 0}));
  EXPECT_NEAR(p.turn_error, std::abs(0.5 - c.space.turn_rate()), 1e-9);
  EXPECT_NEAR(p.commanded_speed, 1, 1e-9);
  EXPECT_EQ(p.jump_error, 0);
  double expected = 0;
  for (int f = 1; f < p.frames; ++f) {
    const double h = 0.5 * f / kRate, x = std::cos(h) * 0.2 + std::sin(h) * 1.5,
                 y = std::cos(h) * 1.5 - std::sin(h) * 0.2;
    expected += std::hypot(x, y - 1) / (p.frames - 1);
  }
  EXPECT_NEAR(p.velocity_error, expected, 1e-9);
  judge(p, c, Trace(20, Control{0, 0, 0, 1}));
  EXPECT_NEAR(p.jump_error, 1, 1e-12);
}

// What a player showed, as a clip that faces as the player did.
Clip shown_clip(const Performance& p) {
  Clip clip{"shown", p.rate, p.frames, p.root_positions, p.rotations, {}};
  for (int f = 0; f < p.frames; ++f) clip.headings.push_back(p.path[std::size_t{3} * f + 2]);
  return clip;
}

TEST(JudgeClip, JudgesWhatAPlayerShowedAsThePlayer) {
  const auto character = gait_character();
  const Trace trace = simulate_trace("explorer", 20, 5, character->space);
  const Performance played = perform(Player(character, {1}), trace, kRate);
  const Performance judged = judge_clip(*character, trace, shown_clip(played), played.entered);
  EXPECT_DOUBLE_EQ(judged.velocity_error, played.velocity_error);
  EXPECT_DOUBLE_EQ(judged.turn_error, played.turn_error);
  EXPECT_DOUBLE_EQ(judged.drift, played.drift);
  EXPECT_DOUBLE_EQ(judged.commanded_speed, played.commanded_speed);
  EXPECT_EQ(judged.entered, played.entered);
  EXPECT_EQ(judged.jump_error, 0);
  EXPECT_TRUE(judged.fragments.empty());
}

TEST(JudgeClip, RefusesWhatDoesNotFit) {
  const auto character = gait_character();
  const Trace trace(20, kForward);
  const Performance played = perform(Player(character, {1}), trace, kRate);
  const Clip clip = shown_clip(played);
  EXPECT_THROW(judge_clip(*character, {}, clip, played.entered), std::invalid_argument);
  EXPECT_THROW(judge_clip(*character, Trace(21, kForward), clip, played.entered), std::invalid_argument);
  EXPECT_THROW(judge_clip(*character, trace, clip, {0, 1}), std::invalid_argument);
  EXPECT_THROW(judge_clip(tiny_character(), trace, clip, played.entered), std::invalid_argument);
}

// Goes as the control says from a place on, in circles, `drift` m/s to the north too.
Performance circling(const Control& control, double turn_rate, double seconds, double drift) {
  Performance p;
  p.rate = kRate;
  p.frames = static_cast<int>(std::lround(seconds * kRate)) + 1;
  const double turning = control.turn * turn_rate;
  for (int f = 0; f < p.frames; ++f) {
    const double t = f / kRate, heading = 1 + turning * t;
    const Vector2 swept{std::sin(heading) - std::sin(1), std::cos(1) - std::cos(heading)},
        place = Vector2{control.x * swept.x() - control.y * swept.y(), control.x * swept.y() + control.y * swept.x()} /
                turning;
    p.path.insert(p.path.end(), {3 + place.x(), place.y() - 2 + drift * t, heading});
    p.fragments.push_back(0);
  }
  return p;
}

TEST(Judge, MeasuresHowFarTheRootDriftsFromTheExactPath) {
  const Character c = tiny_character();
  for (const Control& control : {Control{0.4, 2, 1, 0}, Control{-1, 0.3, -1, 0}}) {
    for (const double drift : {0.0, 0.1, 0.4}) {
      for (const double seconds : {0.5, 2.0, 10.0}) {
        Performance p = circling(control, c.space.turn_rate(), seconds, drift);
        judge(p, c, Trace(static_cast<std::size_t>(10 * seconds), control));
        EXPECT_NEAR(p.drift, drift, 1e-3) << drift << " m/s in " << seconds << " s";
      }
    }
  }
}

TEST(Judge, SeesNoErrorInTheSwayOfAGait) {
  const Character c = tiny_character();
  Performance p;
  p.rate = kRate;
  p.frames = 301;
  for (int f = 0; f < p.frames; ++f) {  // sways by 2 cm, twice a second
    p.path.insert(p.path.end(), {0.02 * std::sin(4 * kPi * f / kRate), 1.2 * f / kRate, 0});
    p.fragments.push_back(0);
  }
  judge(p, c, Trace(50, Control{0, 1.2, 0, 0}));
  EXPECT_LT(p.velocity_error, 0.1);  // frame by frame it would be 0.16
  EXPECT_LT(p.drift, 0.01);
}

TEST(Performance, IsWhatStepsWouldHaveShown) {
  const Trace trace(40, kForward);
  Player one(gait_character(), {6}), two(gait_character(), {6});
  one.reset({{1, 1}, 1});
  two.reset({{1, 1}, 1});
  const Performance p = perform(one, trace, 30);
  for (int f = 0; f < p.frames; ++f) {
    if (f > 0) two.step(kForward, 1.0 / 30);
    EXPECT_LT((load_vector(&p.root_positions[3 * f]) - two.root_position()).norm(), 1e-9);
    EXPECT_NEAR(p.path[3 * f + 2], two.frame().heading, 1e-9);
    EXPECT_EQ(p.classes[f], two.playing_class());
    EXPECT_EQ(gait_character()->classes.labels[p.fragments[f]], p.classes[f]);
  }
}

TEST(Performance, KnowsThatAFragmentFollowsItself) {
  const auto character = std::make_shared<const Character>(tiny_character({tiny_clip(1.5)}));
  ASSERT_EQ(character->pool.fragments.size(), 1);
  Player player(character);
  const Trace trace(20, Control{});
  for (int run = 0; run < 2; ++run) {
    const Performance p = perform(player, trace, 60);
    for (int f = 1; f < p.frames; ++f) EXPECT_EQ(p.entered[f], (f - 1 + 30 * run) / 30) << f;
  }
}

TEST(Performance, MeasuresQualityAndSpeed) {
  for (const double rate : {24.0, 60.0}) {
    const Performance p =
        perform(Player(gait_character(), {3}), simulate_trace("explorer", 20, 4, gait_character()->space), rate);
    EXPECT_GT(p.quality, 0);
    EXPECT_LE(p.quality, 1);
    EXPECT_GE(p.velocity_error, 0);
    EXPECT_TRUE(std::isfinite(p.velocity_error));
  }
  Player player(gait_character());
  EXPECT_NEAR(perform(player, Trace(50, kForward), 30).commanded_speed, 1.2, 0.05);
}

TEST(Performance, PathIsUnwrapped) {
  Gait gait;
  gait.turn = 1.2;
  BuildOptions options;
  options.classes = 3;
  options.mirror = options.synthesize = false;
  options.policies = {"greedy"};
  Player player(std::make_shared<const Character>(build(humanoid(), {gait_clip(gait)}, {Trace(2)}, options)));
  const Performance p = perform(player, Trace(100, Control{0, 1.2, 1, 0}), 30);  // ten seconds in a circle
  for (int f = 1; f < p.frames; ++f) EXPECT_LT(std::abs(p.path[3 * f + 2] - p.path[3 * f - 1]), 1);
  EXPECT_NEAR(p.path[3 * (p.frames - 1) + 2], 12, 1);
}

}  // namespace
}  // namespace fragmotion

// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "fragmotion/performance.hpp"
#include "fragmotion/player.hpp"
#include "small_character.hpp"

namespace fragmotion {
namespace {

constexpr double kRate = 60;

TEST(OptimalPerformance, IsNeverReachedByAPlayer) {
  const auto character = gait_character();
  for (const std::string& name : simulated_players()) {
    const Trace trace = simulate_trace(name, 30, 5, character->space);
    const double best = optimal_performance(*character, trace, kRate, kStitch);
    EXPECT_LT(best, 1);
    for (const std::uint64_t seed : {1, 2, 3}) {
      const double reached = Player(character, seed).run(trace, kRate).quality;
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
      const int control = random.below(ControlSpace::kPoints);
      trace.push_back(c.space.point(control));
      controls.insert(controls.end(), 2, control);
    }
    const double expected =
        std::max(brute_force(c, controls, 0, 0, shortest, longest), brute_force(c, controls, 0, 1, shortest, longest));
    EXPECT_NEAR(optimal_performance(c, trace, kFew, 0.15) * 14, expected, 1e-9);
  }
}

TEST(OptimalPerformance, RefusesAnEmptyTraceAndARateOfNothing) {
  const Character c = tiny_character();
  EXPECT_THROW(optimal_performance(c, {}, kRate, kStitch), std::invalid_argument);
  EXPECT_THROW(optimal_performance(c, {{}, {}}, 0, kStitch), std::invalid_argument);
}

TEST(Performance, JudgesWhatItShows) {
  const auto character = gait_character();
  const Trace trace = simulate_trace("explorer", 20, 9, character->space);
  const Performance p = Player(character).run(trace, kRate);
  double velocity = 0, turn = 0, jump = 0;
  for (int f = 1; f < p.frames; ++f) {
    const double* now = &p.path[3 * f];
    const double* before = now - 3;
    const Control& control = trace[std::min<std::size_t>((f - 1) / 6, trace.size() - 1)];
    const double x = (now[0] - before[0]) * kRate, y = (now[1] - before[1]) * kRate, h = before[2];
    velocity +=
        std::hypot(std::cos(h) * x + std::sin(h) * y - control.x, std::cos(h) * y - std::sin(h) * x - control.y);
    turn += std::abs((now[2] - before[2]) * kRate - control.turn * character->space.turn_rate());
    jump += (character->pool.fragments[p.fragments[f]].evident.jump > 0.5) != (control.jump > 0.5) ? 1 : 0;
  }
  EXPECT_NEAR(p.velocity_error, velocity / (p.frames - 1), 1e-9);
  EXPECT_NEAR(p.turn_error, turn / (p.frames - 1), 1e-9);
  EXPECT_NEAR(p.jump_error, jump / (p.frames - 1), 1e-9);
}

}  // namespace
}  // namespace fragmotion

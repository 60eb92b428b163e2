// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <vector>

#include "motion/treading.hpp"

namespace fragmotion {
namespace {

constexpr int kCycle = 20, kRounds = 4;

// A sole of one point that goes back at these speeds, m/s, each for a thirtieth of a second, as it stands from a frame
// of each cycle on; then it is lifted and goes forth to where it stood.
SolePath sole(int from, const std::vector<double>& speeds) {
  const int stance = static_cast<int>(speeds.size()), swing = kCycle - stance;
  double back = 0;
  for (const double speed : speeds) back += speed / 30;
  SolePoint point;
  double place = 0;
  for (int f = 0; f < kCycle * kRounds; ++f) {
    const int part = (f - from + kCycle) % kCycle;
    point.path.emplace_back(0, place, part > stance ? 0.3 : 0);
    place += part < stance ? -speeds[part] / 30 : back / swing;
  }
  return {point.path, {point}};
}

double mean_speed(const std::vector<double>& left, const std::vector<double>& right) {
  Clip clip{"run", 30, kCycle * kRounds, {}, {}, {}};
  clip.headings.assign(clip.frames, 0);
  return mean_velocity(Treading({sole(0, left), sole(10, right)}, clip, 1).velocities(0, {0, 0})).y();
}

// As of a run's feet that slide back before they leave.
TEST(Treading, IsToldByWhatMostOfAStanceAgreesWith) {
  const std::vector<double> steady(6, 5), slides{5, 5, 5, 5, 6, 7};
  EXPECT_NEAR(mean_speed(steady, steady), 5, 0.05);
  EXPECT_LT(mean_speed(slides, slides), 6);
  EXPECT_GE(mean_speed(slides, slides), 5);
}

}  // namespace
}  // namespace fragmotion

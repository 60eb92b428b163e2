// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <vector>

#include "motion/steadiest_speed.hpp"

namespace fragmotion {
namespace {

TEST(SteadiestSpeed, IsWhatMostAgreesWithAndNoMean) {
  ToldSpeeds told;  // a foot slaps the ground, then stands on it for three times as long
  for (int f = 0; f < 80; ++f) {
    told.speeds.push_back(f % 40 < 10 ? 3 : 1);
    told.weights.push_back(1);
  }
  for (const double speed : steadiest_speed({told}, 0.1, 0.05)) EXPECT_NEAR(speed, 1, 0.04);
}

TEST(SteadiestSpeed, FollowsWhatChangesNoFasterThanItMay) {
  ToldSpeeds slow, fast;
  for (int f = 0; f < 60; ++f) {
    slow.speeds.push_back(1 + 0.02 * f), slow.weights.push_back(1);
    fast.speeds.push_back(1 + 0.5 * (f % 4)), fast.weights.push_back(0.2);
  }
  const std::vector<double> speeds = steadiest_speed({slow, fast}, 0.1, 0.05);
  ASSERT_EQ(speeds.size(), slow.speeds.size());
  for (std::size_t f = 0; f < speeds.size(); ++f) EXPECT_NEAR(speeds[f], slow.speeds[f], 0.06 * slow.speeds[f]) << f;
}

TEST(SteadiestSpeed, GoesOnWhereNothingIsTold) {
  const ToldSpeeds told{{2, 2, -1, 0, -3, 2, 2}, {1, 1, 0, 1, 1, 1, 1}};
  for (const double speed : steadiest_speed({told}, 0.1, 0.1)) EXPECT_NEAR(speed, 2, 1e-9);
}

TEST(SteadiestSpeed, IsNoneOfWhatIsTooSlow) {
  EXPECT_TRUE(steadiest_speed({{{0.1, 0.2}, {1, 1}}}, 0.3, 0.1).empty());
  EXPECT_TRUE(steadiest_speed({{{2, 2}, {0, 0}}}, 0.3, 0.1).empty());
}

}  // namespace
}  // namespace fragmotion

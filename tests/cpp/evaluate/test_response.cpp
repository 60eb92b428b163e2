// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>

#include "evaluate/response.hpp"
#include "small_character.hpp"

namespace fragmotion {
namespace {

TEST(ResponseTimes, AreOneForEveryStepBetweenVelocities) {
  const std::vector<double> times = response_times(gait_character());
  EXPECT_EQ(times.size(), 17u * 16u);
  for (const double time : times) EXPECT_TRUE(time >= 0 && time <= kNoResponse) << time;
  EXPECT_LT(std::count(times.begin(), times.end(), 0.0), 30);
  EXPECT_EQ(times, response_times(gait_character()));
}

TEST(ResponseTimes, TellWhatAPolicyCannotDo) {
  // Its takes stand, or walk forward: no step to another direction is ever answered. Others do what
  // they are able to.
  const auto stands = std::make_shared<const Character>(tiny_character());
  const std::vector<double> times = response_times(stands);
  EXPECT_GT(std::count(times.begin(), times.end(), kNoResponse), 100);
  const std::vector<double> able = response_times(gait_character());
  EXPECT_LT(std::count(able.begin(), able.end(), kNoResponse), 30);
}

}  // namespace
}  // namespace fragmotion

// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <numeric>

#include "evaluate/body_track.hpp"
#include "evaluate/spread.hpp"

namespace fragmotion {
namespace {

TEST(Spread, IsOfPercentiles) {
  std::vector<double> values(1001);
  std::iota(values.rbegin(), values.rend(), 0);
  const Spread found = spread(values);
  EXPECT_EQ(found.p50, 500);
  EXPECT_EQ(found.p99, 990);
  EXPECT_EQ(found.p999, 999);
  EXPECT_EQ(found.worst, 1000);
  EXPECT_EQ(spread({}).worst, 0);
}

TEST(Pushes, TellHowOftenABodyIsPushedHard) {
  const Pushes found = pushes({1, 6, 6.1, 9});
  EXPECT_EQ(found.over_6, 0.5);
  EXPECT_EQ(found.worst, 9);
}

TEST(Accelerations, AreThoseOfAParabola) {
  std::vector<Vector3> path;
  std::vector<double> angles;
  for (int f = 0; f < 60; ++f) {
    const double t = f / 60.0;
    path.emplace_back(1.5 * t * t, 3 * t - 2 * t * t, 7 * t * t);
    angles.push_back(4 * t - 1.25 * t * t);
  }
  const std::vector<double> found = ground_accelerations(path, 60), turns = angular_accelerations(angles, 60);
  ASSERT_EQ(found.size(), 60u - 24u);
  for (const double a : found) EXPECT_NEAR(a, 5, 1e-9);
  for (const double a : turns) EXPECT_NEAR(a, 2.5, 1e-9);
}

}  // namespace
}  // namespace fragmotion

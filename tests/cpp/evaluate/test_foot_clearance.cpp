// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "evaluate/foot_clearance.hpp"

namespace fragmotion {
namespace {

TEST(FootClearance, IsWhereAllButAFiftiethOfThoseAreThatAreAsFast) {
  std::vector<FootClearance::Moment> moments;
  for (int i = 0; i < 1000; ++i) moments.push_back({0.01 * (i % 10), 0});
  for (int i = 0; i < 1000; ++i) moments.push_back({2, i < 15 ? 0.01 : 0.05});
  const FootClearance clearance(moments);
  EXPECT_EQ(clearance.at(0), 0);
  EXPECT_EQ(clearance.at(0.05), 0);
  EXPECT_NEAR(clearance.at(2), 0.05, 1e-12);
  EXPECT_NEAR(clearance.at(9), 0.05, 1e-12);
  EXPECT_GT(clearance.at(1), 0.01);
  EXPECT_LT(clearance.at(1), 0.04);
}

TEST(FootClearance, IsNoneOfNothingAndUnderTheFloor) {
  EXPECT_EQ(FootClearance().at(1), 0);
  EXPECT_EQ(FootClearance({{1, -0.2}, {2, -0.1}}).at(3), 0);
}

}  // namespace
}  // namespace fragmotion

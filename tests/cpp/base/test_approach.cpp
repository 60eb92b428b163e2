// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "base/approach.hpp"

namespace fragmotion {
namespace {

TEST(Approach, GetsThereAtTheTimeAndAtRest) {
  Approach one{1, -2}, many{1, -2};
  one.advance(3, 0.5, 0.25);
  for (int i = 0; i < 5; ++i) many.advance(3, 0.5 - 0.05 * i, 0.05);
  EXPECT_NEAR(one.value, many.value, 1e-12) << "whatever the steps";
  EXPECT_NEAR(one.speed, many.speed, 1e-12);
  many.advance(3, 0.25, 0.25);
  EXPECT_EQ(many.value, 3);
  EXPECT_EQ(many.speed, 0);
}

}  // namespace
}  // namespace fragmotion

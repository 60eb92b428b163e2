// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "base/quantile.hpp"

namespace fragmotion {
namespace {

// numpy.quantile([3, -1, 4, 1.5, -9, 2.6], share)
TEST(Quantile, IsThatOfNumPy) {
  const std::vector<double> values{3, -1, 4, 1.5, -9, 2.6};
  EXPECT_DOUBLE_EQ(quantile(values, 0), -9);
  EXPECT_DOUBLE_EQ(quantile(values, 0.02), -8.2);
  EXPECT_DOUBLE_EQ(quantile(values, 0.25), -0.375);
  EXPECT_DOUBLE_EQ(quantile(values, 0.5), 2.05);
  EXPECT_DOUBLE_EQ(quantile(values, 0.75), 2.9);
  EXPECT_DOUBLE_EQ(quantile(values, 0.999), 3.995);
  EXPECT_DOUBLE_EQ(quantile(values, 1), 4);
}

TEST(Quantile, OfOneValueIsThat) {
  for (const double share : {0.0, 0.3, 1.0}) EXPECT_EQ(quantile({7}, share), 7);
}

TEST(Median, IsTheMiddleOrTheMeanOfTwo) {
  EXPECT_EQ(median({5, 1, 2}), 2);
  EXPECT_EQ(median({5, 1, 2, 4}), 3);
}

}  // namespace
}  // namespace fragmotion

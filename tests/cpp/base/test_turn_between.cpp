// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/random.hpp"
#include "base/turn_between.hpp"

namespace fragmotion {
namespace {

Vector3 random_vector(Random& random) {
  return {2 * random.uniform() - 1, 2 * random.uniform() - 1, 2 * random.uniform() - 1};
}

TEST(TurnBetween, IsTheLeastThatBringsOneDirectionToAnother) {
  Random random(1);
  for (int i = 0; i < 1000; ++i) {
    const Vector3 from = random_vector(random), to = 3 * random_vector(random);
    const Quaternion turn = turn_between(from, to);
    EXPECT_LT((turn * from.normalized() - to.normalized()).norm(), 1e-12);
    EXPECT_NEAR(turn.angularDistance(Quaternion::Identity()), std::acos(from.normalized().dot(to.normalized())), 1e-6);
  }
}

TEST(TurnBetween, IsExactHoweverNearlyOppositeTheyAre) {
  Random random(2);
  for (double off = 1e-16; off < 0.1; off *= 10) {
    const Vector3 from = random_vector(random).normalized(), to = (off * random_vector(random) - from).normalized();
    const Quaternion turn = turn_between(from, to);
    EXPECT_NEAR(turn.norm(), 1, 1e-12);
    EXPECT_LT((turn * from - to).norm(), 1e-9) << off;
    EXPECT_NEAR(turn.angularDistance(Quaternion::Identity()), kPi, 2 * off + 1e-6);
  }
}

TEST(TurnBetween, IsTheSameHoweverLongTheDirectionsAre) {
  const Vector3 from{1, 2, -3}, to{-2, 0.5, 1};
  EXPECT_TRUE(turn_between(1e300 * from, 1e300 * to).isApprox(turn_between(from, to), 1e-12));
  EXPECT_TRUE((turn_between(1e300 * from, -1e300 * from) * from).isApprox(-from, 1e-6));
  const double infinite = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(turn_between({infinite, 0, 0}, to).isApprox(Quaternion::Identity()));
}

TEST(TurnBetween, IsNoneOfNoDirection) {
  EXPECT_EQ(turn_between(Vector3::Zero(), Vector3::UnitX()).w(), 1);
  EXPECT_EQ(turn_between(Vector3::UnitX(), Vector3::Zero()).w(), 1);
}

}  // namespace
}  // namespace fragmotion

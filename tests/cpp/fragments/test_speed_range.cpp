// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>

#include "base/random.hpp"
#include "fragments/speed_range.hpp"

namespace fragmotion {
namespace {

const ControlSpace kSpace(1.2, 3.3, 1.2, 1);
constexpr double kDegree = kPi / 180;

Control going(double speed, double degrees, double turn = 0.3) {
  return {speed * std::sin(degrees * kDegree), speed * std::cos(degrees * kDegree), turn, 0.25};
}

Fragment fragment(const Control& evident, Origin origin = Origin::captured) {
  Fragment fragment;
  fragment.evident = evident;
  fragment.origin = origin;
  return fragment;
}

double most(const SpeedRange& range, double degrees) { return range.within(going(100, degrees)).speed(); }

TEST(SpeedRange, IsOfWhatTheTakesShowWithinThirtyDegrees) {
  Random random(3);
  std::vector<Fragment> fragments;
  for (int i = 0; i < 12; ++i) {
    const auto origin = i % 2 == 0 ? Origin::captured : Origin::mirrored;
    fragments.push_back(fragment(going(4 * random.uniform(), 360 * random.uniform()), origin));
  }
  const SpeedRange range(fragments, kSpace);
  for (int degrees = -180; degrees <= 180; degrees += 5) {
    double expected = kSpace.walk();
    for (const Fragment& f : fragments) {
      const Control there = going(1, degrees);
      const double cosine = (f.evident.x * there.x + f.evident.y * there.y) / f.evident.speed();
      if (cosine > std::cos(30 * kDegree)) expected = std::max(expected, 1.3 * f.evident.speed());
    }
    EXPECT_NEAR(most(range, degrees), expected, 1e-9) << degrees;
  }
}

TEST(SpeedRange, ChangesNothingButHowFastOneGoesAndThatWithoutJumps) {
  const SpeedRange range({fragment(going(3, 10))}, kSpace);
  const Control asked = going(5, 100), able = range.within(asked);
  EXPECT_NEAR(able.x * asked.y, able.y * asked.x, 1e-12);
  EXPECT_EQ(able.turn, asked.turn);
  EXPECT_EQ(able.jump, asked.jump);
  double before = most(range, 0);
  for (double degrees = 0; degrees <= 360; degrees += 0.5) {
    const double now = most(range, degrees);
    EXPECT_LE(std::abs(now - before), 0.1 * (1.3 * 3 - kSpace.walk()) + 1e-9) << degrees;
    before = now;
  }
}

TEST(SpeedRange, LeavesAloneWhatIsWithinItAndWalksEverywhere) {
  const SpeedRange range({fragment(going(3, 0))}, kSpace);
  for (double degrees = 0; degrees < 360; degrees += 7) {
    for (const double speed : {0.0, 0.5, 1.2}) {
      const Control asked = going(speed, degrees), able = range.within(asked);
      EXPECT_EQ(able.x, asked.x);
      EXPECT_EQ(able.y, asked.y);
    }
  }
  EXPECT_EQ(range.within(going(3.9, 20)).speed(), going(3.9, 20).speed());
  EXPECT_LT(range.within(going(3.91, 20)).speed(), 3.905);
  EXPECT_LT(range.within(going(1.3, 180)).speed(), 1.205);
}

TEST(SpeedRange, TakesNoNoticeOfWhatIsMade) {
  const SpeedRange range({fragment(going(3, 180), Origin::transformed), fragment(going(3, 90), Origin::interpolated)},
                         kSpace);
  for (double degrees = 0; degrees < 360; degrees += 7) EXPECT_NEAR(most(range, degrees), kSpace.walk(), 1e-12);
}

TEST(SpeedRange, TakesNoNoticeOfWhatTurnsUnlessItGoesAhead) {
  for (const double turn : {-0.5, 0.5}) {
    for (const double degrees : {0, 25, 90, 180}) {
      const SpeedRange range({fragment(going(3, degrees, turn))}, kSpace);
      EXPECT_NEAR(most(range, degrees), degrees <= 30 ? 1.3 * 3 : kSpace.walk(), 1e-9) << degrees;
    }
  }
}

}  // namespace
}  // namespace fragmotion

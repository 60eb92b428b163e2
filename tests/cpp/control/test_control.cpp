// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "base/random.hpp"
#include "control/control.hpp"

namespace fragmotion {
namespace {

TEST(ControlSpace, NumbersItsPointsAsDocumented) {
  const ControlSpace space(1, 2);
  for (int i = 0; i < kPaperPoints; ++i) {
    const Control& point = space.point(i);
    const int velocity = i / 6;
    EXPECT_EQ(i, 6 * velocity + 2 * (point.turn + 1) + point.jump);
    EXPECT_NEAR(std::hypot(point.x, point.y), velocity == 0 ? 0 : velocity <= 8 ? 1 : 2, 1e-15);
  }
}

TEST(ControlSpace, TellsAPointsPartsAndThePointOfThem) {
  const ControlSpace space;
  for (int i = 0; i < kPaperPoints; ++i) {
    const Control& point = space.point(i);
    const int velocity = ControlLayout().velocity_of(i);
    EXPECT_EQ(velocity, i / 6);
    EXPECT_EQ(ControlLayout().turn_of(i), point.turn);
    EXPECT_EQ(ControlLayout().is_jump(i), point.jumps());
    EXPECT_EQ(ControlLayout().index(velocity, ControlLayout().turn_of(i), ControlLayout().is_jump(i)), i);
    EXPECT_EQ(velocity > 0 && ControlLayout().speed_of(velocity) == 1, point.speed() > 2);
  }
  for (const int gait : {1, 9}) EXPECT_EQ(ControlLayout().direction_of(gait + 5), 5);
}

TEST(MatchesJump, TakesABouncyRunForARun) {
  const Control run{0, 3, 0, 0}, leap{0, 3, 0, 1};
  const auto evident = [](double jump) { return Control{0, 3, 0, jump}; };
  EXPECT_TRUE(matches_jump(evident(0.7), run));
  EXPECT_FALSE(matches_jump(evident(0.95), run));
  EXPECT_TRUE(matches_jump(evident(0.8), leap));
  EXPECT_FALSE(matches_jump(evident(0.7), leap));
}

TEST(ControlSpace, TurnsTowardsWhereItShallFaceNoFasterThanItCan) {
  const double slow = 60 * kPi / 180, fast = 4;
  EXPECT_NEAR(ControlSpace(1, 2, slow).quickest_turn() * slow, 170 * kPi / 180, 1e-12);
  EXPECT_EQ(ControlSpace(1, 2, fast).quickest_turn(), 1);
  for (const double rate : {slow, fast}) {
    const ControlSpace space(1, 2, rate);
    EXPECT_EQ(space.turn_towards(kPi), space.quickest_turn());
    EXPECT_EQ(space.turn_towards(-kPi), -space.quickest_turn());
    double off = 2.5;
    for (int f = 0; f < 120; ++f) {
      const double next = off - space.turn_towards(off) * rate / 60;
      EXPECT_LT(next, off);
      EXPECT_GE(next, 0);
      off = next;
    }
    EXPECT_LT(off, 0.02);
  }
}

TEST(ControlSpace, CountsDirectionsCounterClockwiseFromForward) {
  const ControlSpace space(1, 2);
  const auto velocity = [&](int index) { return Vector2{space.point(6 * index).x, space.point(6 * index).y}; };
  EXPECT_EQ(velocity(0), Vector2(0, 0));
  EXPECT_EQ(velocity(1), Vector2(0, 1));   // forward
  EXPECT_EQ(velocity(3), Vector2(-1, 0));  // left
  EXPECT_EQ(velocity(5), Vector2(0, -1));  // back
  EXPECT_EQ(velocity(7), Vector2(1, 0));   // right
  EXPECT_EQ(velocity(9), Vector2(0, 2));
  EXPECT_LT((velocity(10) - Vector2(-std::sqrt(2), std::sqrt(2))).norm(), 1e-15);
}

TEST(ControlSpace, FindsEachPointNearestToItself) {
  const ControlSpace space;
  for (int i = 0; i < kPaperPoints; ++i) EXPECT_EQ(space.nearest(space.point(i)), i);
}

TEST(ControlSpace, FindsNoPointNearerThanTheNearest) {
  const ControlSpace space(1.1, 3.4, 1, 0.9, {1, 0.7, 1.5});
  Random random(3);
  for (int n = 0; n < 300; ++n) {
    const Control control{8 * random.uniform() - 4, 8 * random.uniform() - 4, 2 * random.uniform() - 1,
                          random.uniform()};
    const double found = space.distance(space.point(space.nearest(control)), control);
    for (int i = 0; i < kPaperPoints; ++i) EXPECT_LE(found, space.distance(space.point(i), control));
  }
}

int first_of_the_nearest(const ControlSpace& space, const Control& control) {
  int best = 0;
  for (int i = 1; i < kPaperPoints; ++i) {
    if (space.distance(space.point(i), control) < space.distance(space.point(best), control)) best = i;
  }
  return best;
}

TEST(ControlSpace, FindsTheFirstOfTheNearestPoints) {
  Random random(4);
  const auto quarters = [&](int count) { return 0.25 * random.below(2 * count + 1) - 0.25 * count; };
  const ControlSpace spaces[] = {ControlSpace(1, 2), ControlSpace(1, 2, 1, 0.5, {1, 2, 4}),
                                 ControlSpace(1, 2, 1, 1, {0, 1, 1}), ControlSpace(1, 2, 1, 1, {1, 0, 0}),
                                 ControlSpace(1.3, 3.1, 1, 1.2)};
  for (const ControlSpace& space : spaces) {
    for (int n = 0; n < 2000; ++n) {
      const Control tied{quarters(12), quarters(12), quarters(6), quarters(6)};
      const Control any{6 * random.uniform() - 3, 6 * random.uniform() - 3, 3 * random.uniform() - 1.5,
                        2 * random.uniform() - 0.5};
      for (const Control& control : {tied, any}) {
        EXPECT_EQ(space.nearest(control), first_of_the_nearest(space, control))
            << control.x << " " << control.y << " " << control.turn << " " << control.jump;
      }
    }
  }
}

TEST(ControlSpace, PrefersTheLowerIndexOnATie) {
  const ControlSpace space(1, 2);
  EXPECT_EQ(space.nearest({0, 0.5, 0, 0}), 2);      // between standing and walking
  EXPECT_EQ(space.nearest({0, 1.5, 0, 0}), 6 + 2);  // between walking and running
  EXPECT_EQ(space.nearest({0, 0, 0, 0.5}), 2);      // between jumping and not
  EXPECT_EQ(space.nearest({0, 0, -0.5, 0}), 0);     // between turning right and not
}

TEST(ControlSpace, WeighsDifferencesBeforeSquaring) {
  const ControlSpace space(1, 2, 1, 0.5, {3, 5, 7});
  const Control origin;
  EXPECT_DOUBLE_EQ(space.distance(origin, {3, 4, 0, 0}), 3 * 0.5 * 5);
  EXPECT_DOUBLE_EQ(space.distance(origin, {0, 0, -1, 0}), 5);
  EXPECT_DOUBLE_EQ(space.distance(origin, {0, 0, 0, 1}), 7);
  EXPECT_DOUBLE_EQ(space.distance(origin, {2, 0, 1, 1}), std::sqrt(9 + 25 + 49));
}

TEST(ControlSpace, HasAMetric) {
  const ControlSpace space;
  for (int a = 0; a < kPaperPoints; a += 7) {
    for (int b = 0; b < kPaperPoints; b += 5) {
      const double ab = space.distance(space.point(a), space.point(b));
      EXPECT_EQ(ab, space.distance(space.point(b), space.point(a)));
      EXPECT_EQ(ab == 0, a == b);
      for (int c = 0; c < kPaperPoints; c += 3)
        EXPECT_LE(ab, space.distance(space.point(a), space.point(c)) + space.distance(space.point(c), space.point(b)) +
                          1e-12);
    }
  }
}

TEST(ControlSpace, IgnoresWhatHasNoWeight) {
  const ControlSpace turnless(1, 2, 1, 1, {2, 0, 4}), blind(1, 2, 1, 1, {0, 0, 0});
  EXPECT_EQ(turnless.distance({1, 1, 0.7, 1}, {1, 1, -0.2, 1}), 0);
  EXPECT_EQ(turnless.distance({1, 0, 0.7, 1}, {0, 0, -0.2, 1}), 2);
  EXPECT_EQ(turnless.nearest({0, 1, 1, 0}), turnless.nearest({0, 1, -1, 0}));
  for (int i = 0; i < kPaperPoints; ++i) EXPECT_EQ(blind.nearest(blind.point(i)), 0);
}

TEST(ControlSpace, NamesTheValueThatIsOutOfRange) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const struct {
    const char* label;
    double walk, run, turn_rate, scale;
    ControlWeights weights;
    const char* named;
  } cases[] = {
      {"no walk", 0, 2, 1, 1, {}, "walk"},
      {"walk is not a number", nan, 2, 1, 1, {}, "walk"},
      {"run slower than walk", 2, 1, 1, 1, {}, "run"},
      {"infinite run", 1, INFINITY, 1, 1, {}, "run"},
      {"run whose square is no number", 1, 1e300, 1, 1, {}, "run"},
      {"negative turn rate", 1, 2, -1, 1, {}, "turn rate"},
      {"no scale", 1, 2, 1, 0, {}, "scale"},
      {"negative velocity weight", 1, 2, 1, 1, {-1, 1, 1}, "velocity weight"},
      {"turn weight is not a number", 1, 2, 1, 1, {1, nan, 1}, "turn weight"},
      {"infinite jump weight", 1, 2, 1, 1, {1, 1, INFINITY}, "jump weight"},
  };
  for (const auto& c : cases) {
    SCOPED_TRACE(c.label);
    try {
      ControlSpace(c.walk, c.run, c.turn_rate, c.scale, c.weights);
      ADD_FAILURE() << "accepted";
    } catch (const std::invalid_argument& error) {
      EXPECT_NE(std::string(error.what()).find(c.named), std::string::npos) << error.what();
    }
  }
}

}  // namespace
}  // namespace fragmotion

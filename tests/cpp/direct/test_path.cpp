// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

#include "direct/path.hpp"

namespace fragmotion {
namespace {

std::vector<Vector2> random_points(unsigned seed, int count) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> coordinate(-5, 5);
  std::vector<Vector2> points;
  for (int i = 0; i < count; ++i) points.emplace_back(coordinate(random), coordinate(random));
  return points;
}

TEST(Path, MeasuresTheWayAlongItsLines) {
  const Path open({{0, 0}, {3, 0}, {3, 0}, {3, 4}}), closed({{0, 0}, {3, 0}, {3, 4}}, true);
  EXPECT_DOUBLE_EQ(open.length(), 7);
  EXPECT_DOUBLE_EQ(closed.length(), 12);
  EXPECT_EQ(open.place(5), Vector2(3, 2));
  EXPECT_EQ(open.place(-1), Vector2(-1, 0)) << "straight on before the beginning";
  EXPECT_EQ(open.place(9), Vector2(3, 6)) << "and behind the end";
  EXPECT_LT((closed.place(12 * 3 + 5) - Vector2(3, 2)).norm(), 1e-9);
  EXPECT_LT((closed.place(-12 + 5) - Vector2(3, 2)).norm(), 1e-9);
  EXPECT_DOUBLE_EQ(open.closed().length(), 12);
}

TEST(Path, FindsTheNearestPlaceAsBruteForceDoes) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    const Path path(random_points(seed, 12), seed % 2 == 0);
    const double from = 0.3 * path.length() * (seed % 5), to = from + 0.4 * path.length();
    for (const Vector2& point : random_points(seed + 100, 20)) {
      double least = std::numeric_limits<double>::infinity();
      for (int i = 0; i <= 20000; ++i)
        least = std::min(least, (path.place(from + (to - from) * i / 20000) - point).norm());
      const double way = path.nearest(point, from, to);
      ASSERT_GE(way, from);
      ASSERT_LE(way, to);
      ASSERT_NEAR((path.place(way) - point).norm(), least, 1e-3) << seed;
    }
  }
}

TEST(Path, DoesNotLeaveAFigureOfEightAtItsCrossing) {
  const Path path({{-1, -1}, {1, 1}, {1, -1}, {-1, 1}}, true);
  EXPECT_NEAR(path.nearest({0, 0.1}, 1, 2), std::sqrt(2.0) + 0.1 * std::sqrt(0.5), 1e-9);
}

TEST(Path, PointsAwayFromATurnOnItself) {
  const Path path({{0, 0}, {0, 2}, {0, 0}});
  EXPECT_LT((path.direction(1, 0.2) - Vector2(0, 1)).norm(), 1e-12);
  EXPECT_LT((path.direction(2, 0.2) - Vector2(0, -1)).norm(), 1e-12);
  EXPECT_LT((path.direction(3, 0.2) - Vector2(0, -1)).norm(), 1e-12);
}

TEST(Path, GoesFromSpeedToSpeed) {
  const Path path({{0, 0}, {0, 2}, {0, 4}}, false, {1, 3, 2});
  EXPECT_DOUBLE_EQ(path.speed(1), 2);
  EXPECT_DOUBLE_EQ(path.speed(9), 2);
  EXPECT_DOUBLE_EQ(path.fastest(), 3);
  EXPECT_FALSE(Path({{0, 0}, {0, 2}}).has_speeds());
}

TEST(Path, RefusesWhatIsNone) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  EXPECT_THROW(Path({}), std::invalid_argument);
  EXPECT_THROW(Path({{1, 1}}, true), std::invalid_argument);
  EXPECT_THROW(Path({{1, 1}, {1, 1}, {1, 1}}), std::invalid_argument) << "vertical: no length on the ground";
  EXPECT_THROW(Path({{1, nan}, {1, 1}}), std::invalid_argument);
  EXPECT_THROW(Path({{nan, 1}, {1, 1}}), std::invalid_argument);
  EXPECT_THROW(Path({{1, infinity}, {1, 1}}), std::invalid_argument);
  EXPECT_THROW(Path({{0, 0}, {1, 1}}, false, {1}), std::invalid_argument);
  EXPECT_THROW(Path({{0, 0}, {1, 1}}, false, {1, 0}), std::invalid_argument);
  EXPECT_THROW(Path({{0, 0}, {1, 1}}, false, {1, nan}), std::invalid_argument);
}

}  // namespace
}  // namespace fragmotion

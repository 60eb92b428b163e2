// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "direct/painted_area.hpp"

namespace fragmotion {
namespace {

const PaintedTriangle kSlope{{Vector3{0, 0, 0}, Vector3{2, 0, 1}, Vector3{0, 1, 0}}, {0.2, 1.0, 0.0}};
const PaintedTriangle kFar{{Vector3{5, 5, 0}, Vector3{6, 5, 0}, Vector3{5, 6, 0}}, {0.5, 0.5, 0.5}};
const PaintedTriangle kBare{{Vector3{9, 9, 9}, Vector3{19, 9, 9}, Vector3{9, 19, 9}}, {0, 0, 0}};

double size(const PaintedTriangle& triangle) {
  const auto& [a, b, c] = triangle.corners;
  return (b - a).cross(c - a).norm() / 2;
}

// How much paint is on a triangle, and where the middle of it is: over a triangle of size A, the integral of two
// barycentric shares is A/6 where they are the same, else A/12.
double paint_on(const PaintedTriangle& triangle, Vector3& middle) {
  const double whole = triangle.paint[0] + triangle.paint[1] + triangle.paint[2];
  middle = Vector3::Zero();
  for (int corner = 0; corner < 3; ++corner) {
    middle += triangle.corners[corner] * (triangle.paint[corner] + whole) / (4 * whole);
  }
  return size(triangle) * whole / 3;
}

TEST(PaintedArea, PlacesAreAsLikelyAsTheyArePainted) {
  const PaintedArea area({kSlope, kBare, kFar});
  Random random(7);
  constexpr int kCount = 100000;
  Vector3 on_slope = Vector3::Zero(), expected, far_middle;
  int count = 0;
  for (int i = 0; i < kCount; ++i) {
    const Vector3 place = area.draw(random);
    EXPECT_LT(place.z(), 9);
    if (place.y() < 5) on_slope += place, ++count;
  }
  const double slope = paint_on(kSlope, expected), far = paint_on(kFar, far_middle);
  const double share = slope / (slope + far);
  EXPECT_NEAR(count / double{kCount}, share, 4 * std::sqrt(share * (1 - share) / kCount));
  EXPECT_LT((on_slope / count - expected).norm(), 4 * std::sqrt(1.0 / count));
}

TEST(PaintedArea, PlacesAreApartAsSeenFromAbove) {
  const PaintedArea area({kSlope, kFar});
  Random random(3);
  const std::vector<Vector3> places = area.draw_apart(random, 12, 0.25);
  ASSERT_EQ(places.size(), 12U);
  for (std::size_t i = 0; i < places.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) EXPECT_GE((places[i] - places[j]).head<2>().norm(), 0.25);
  }
  Random again(3);
  EXPECT_EQ(area.draw_apart(again, 12, 0.25), places);
}

TEST(PaintedArea, IsFullWhereThereIsNoRoom) {
  Random random(1);
  const std::size_t found = PaintedArea({kFar}).draw_apart(random, 50, 0.8).size();
  EXPECT_GE(found, 1U);
  EXPECT_LE(found, 3U);
}

TEST(PaintedArea, KeepsThoseOfItsDrawsThatAreFarFromAllBefore) {
  const PaintedArea area({kSlope, kFar});
  Random random(5), same(5);
  constexpr double kSpacing = 0.05;
  std::vector<Vector3> expected;
  while (expected.size() < 100) {
    const Vector3 place = area.draw(same);
    const auto is_near = [&](const Vector3& other) { return (place - other).head<2>().norm() < kSpacing; };
    if (std::none_of(expected.begin(), expected.end(), is_near)) expected.push_back(place);
  }
  EXPECT_EQ(area.draw_apart(random, 100, kSpacing), expected);
}

TEST(PaintedArea, IsSoonFullForAMillionWideApart) {
  Random random(2), same(2);
  const std::size_t found = PaintedArea({kFar}).draw_apart(random, 1000000, 0.5).size();
  EXPECT_GE(found, 1U);
  EXPECT_LE(found, 6U);
  const double next = random.uniform();
  int drawn = 0;
  while (drawn < 100000 && same.uniform() != next) ++drawn;
  EXPECT_LT(drawn, 100000) << "numbers were drawn";
}

// Eight squares of 2 m around a bare one, each of two triangles.
std::vector<PaintedTriangle> ring() {
  std::vector<PaintedTriangle> triangles;
  for (int cell = 0; cell < 9; ++cell) {
    const double x = 2.0 * (cell % 3), y = 2.0 * (cell / 3), paint = cell == 4 ? 0 : 1;
    const Vector3 a{x, y, 0}, b{x + 2, y, 0}, c{x + 2, y + 2, 0}, d{x, y + 2, 0};
    triangles.push_back({{a, b, c}, {paint, paint, paint}});
    triangles.push_back({{a, d, c}, {paint, paint, paint}});  // which turns the other way round
  }
  return triangles;
}

TEST(PaintedArea, WaysAreOnThePaint) {
  const PaintedArea area(ring());
  Random random(11), same(11);
  const std::vector<Vector3> starts{{1, 1, 0}, {5, 3, 0}, {2.5, 5, 0}};
  constexpr int kCount = 40;
  const std::vector<Vector3> places = area.draw_ways(random, starts, kCount);
  ASSERT_EQ(places.size(), starts.size() * kCount);
  std::size_t rounded = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Vector3& from = i % kCount == 0 ? starts[i / kCount] : places[i - 1];
    for (int step = 0; step <= 100; ++step) {
      const Vector3 place = from + step / 100.0 * (places[i] - from);
      EXPECT_FALSE(place.x() > 2 && place.x() < 4 && place.y() > 2 && place.y() < 4) << "the middle is bare";
      EXPECT_TRUE(place.x() >= 0 && place.x() <= 6 && place.y() >= 0 && place.y() <= 6);
    }
    rounded += (places[i].x() > 4) != (from.x() > 4);
  }
  EXPECT_GT(rounded, kCount / 4U) << "they go from side to side";
  EXPECT_EQ(area.draw_ways(same, starts, kCount), places);
}

TEST(PaintedArea, WaysKeepOffTheEdgeWhereTheyDoNotBeginAtIt) {
  const PaintedArea area(ring());
  Random random(11);
  constexpr double kRoom = 0.6;
  constexpr int kCount = 40;
  const std::vector<Vector3> starts{{1, 1, 0}, {0.1, 3, 0}}, places = area.draw_ways(random, starts, kCount, kRoom);
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Vector2 from = (i % kCount == 0 ? starts[i / kCount] : places[i - 1]).head<2>(), to = places[i].head<2>();
    EXPECT_GE(area.edge().room(to), kRoom);
    EXPECT_GE(area.edge().room(from, to), i == kCount ? 0.1 : kRoom);
  }
}

TEST(PaintedArea, WaysThroughWhatIsNarrowKeepToTheMiddle) {
  const PaintedTriangle left{{Vector3{0, 0, 0}, Vector3{0.4, 0, 0}, Vector3{0, 8, 0}}, {1, 1, 1}},
      right{{Vector3{0.4, 0, 0}, Vector3{0.4, 8, 0}, Vector3{0, 8, 0}}, {1, 1, 1}};
  const PaintedArea area({left, right});
  Random random(2);
  for (const Vector3& place : area.draw_ways(random, {{0.2, 1, 0}}, 20, 0.4)) {
    EXPECT_GT(area.edge().room(place.head<2>()), 0.12) << "of 0.2 in the middle";
  }
}

TEST(PaintedArea, PlacesKeepOffTheEdgeWhileThereIsRoom) {
  const PaintedArea area(ring());
  Random random(4);
  for (const Vector3& place : area.draw_apart(random, 8, 1, 0.8)) EXPECT_GE(area.edge().room(place.head<2>()), 0.8);
  const std::vector<Vector3> many = area.draw_apart(random, 60, 0.4, 0.95);
  ASSERT_EQ(many.size(), 60U);
  EXPECT_LT(area.edge().room(many.back().head<2>()), 0.95);
}

TEST(PaintedArea, WhoStandsBesideThePaintStays) {
  Random random(1);
  const Vector3 beside{50, 0, 0};
  EXPECT_EQ(PaintedArea({kFar}).draw_ways(random, {beside}, 3), std::vector<Vector3>(3, beside));
}

TEST(PaintedArea, RefusesWhatIsNoPaintedSurface) {
  PaintedTriangle wrong = kFar;
  wrong.paint[1] = 1.5;
  EXPECT_THROW(PaintedArea({wrong}), std::invalid_argument);
  wrong = kFar;
  wrong.corners[0].x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(PaintedArea({wrong}), std::invalid_argument);
  EXPECT_THROW(PaintedArea({}), std::invalid_argument);
  EXPECT_THROW(PaintedArea({kBare}), std::invalid_argument);
}

}  // namespace
}  // namespace fragmotion

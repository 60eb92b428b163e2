// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "direct/area_edge.hpp"

namespace fragmotion {
namespace {

// Two squares beside each other and one over the corner of the second, each of triangles that turn either way round,
// one of which has its own corner in the middle of the other's side; and a wall.
AreaEdge steps() {
  return AreaEdge({{{{0, 0}, {2, 0}, {2, 2}}},
                   {{{0, 0}, {0, 2}, {2, 2}}},
                   {{{2, 0}, {4, 0}, {2, 1}}},
                   {{{4, 0}, {4, 2}, {2, 1}}},
                   {{{2, 1}, {4, 2}, {2, 2}}},
                   {{{3, 1}, {5, 1}, {5, 3}}},
                   {{{3, 1}, {3, 3}, {5, 3}}},
                   {{{7, 0}, {7, 1}, {7, 2}}}});
}

TEST(AreaEdge, HoldsWhatIsCovered) {
  const AreaEdge edge = steps();
  for (const Vector2& place : {Vector2{1, 1}, Vector2{2, 1}, Vector2{3.5, 1.5}, Vector2{4.5, 2.5}, Vector2{2.5, 1.9}})
    EXPECT_TRUE(edge.holds(place)) << place.transpose();
  for (const Vector2& place : {Vector2{-1, 1}, Vector2{4.5, 0.5}, Vector2{2.5, 2.5}, Vector2{7, 1}, Vector2{9, 2}})
    EXPECT_FALSE(edge.holds(place)) << place.transpose();
}

TEST(AreaEdge, TellsTheRoomToItFromWithinAndWithout) {
  const AreaEdge edge = steps();
  EXPECT_NEAR(edge.room(Vector2{2, 0.9}), 0.9, 1e-6) << "sides that two have in common are no edge";
  EXPECT_NEAR(edge.room(Vector2{3.5, 1.6}), 0.6403, 1e-4) << "nor is what lies over another";
  EXPECT_NEAR(edge.room(Vector2{4.5, 0.5}), -0.5, 1e-6);
  EXPECT_NEAR(edge.room(Vector2{-3, -4}), -5, 1e-6);
}

TEST(AreaEdge, TellsHowNearAWayComes) {
  const AreaEdge edge = steps();
  EXPECT_NEAR(edge.room({0.5, 1}, {3.4, 1}), 0.5, 1e-6);
  EXPECT_NEAR(edge.room({1, 1}, {3.5, 2.5}), 0, 1e-6) << "it leaves the area for a while";
  EXPECT_NEAR(edge.room({1, 1}, {1, 9}), 0, 1e-6);
}

TEST(AreaEdge, HasBesideOneWhatIsSquareAcrossAndTheCornersThatJutOut) {
  const AreaEdge::Beside within = steps().beside({1, 1.2}), without = steps().beside({1, -2});
  ASSERT_EQ(within.corners.size(), 2U);
  for (const Vector2& corner : within.corners)
    EXPECT_LT(std::min((corner - Vector2{3, 2}).norm(), (corner - Vector2{4, 1}).norm()), 1e-6) << corner.transpose();
  EXPECT_EQ(within.across.size(), 4U) << "left, right, below and above";
  ASSERT_EQ(without.across.size(), 1U);
  EXPECT_LT((without.across.front() - Vector2{1, 0}).norm(), 1e-6);
  EXPECT_TRUE(without.corners.empty());
}

}  // namespace
}  // namespace fragmotion

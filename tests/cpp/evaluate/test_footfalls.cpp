// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <utility>

#include "evaluate/footfalls.hpp"
#include "made_track.hpp"

namespace fragmotion {
namespace {

// A body that goes at `speed` m/s and whose feet come down at these times, s, for a tenth of a second.
BodyTrack stepping(double speed, const std::vector<std::pair<double, int>>& falls) {
  BodyTrack track = standing_track(4);
  move(track, false, [&](double t) { return Vector3(0, speed * t, 0); });
  for (int side = 0; side < 2; ++side) {
    for (int f = 0; f < track.frames(); ++f) {
      track.stands[side][f] = false;
      for (const auto& [time, foot] : falls) {
        const double since = f / track.rate - time;
        if (foot == side && since >= -1e-9 && since < 0.1) track.stands[side][f] = true;
      }
    }
  }
  return track;
}

TEST(Footfalls, OfAWalkAlternate) {
  const Footfalls found = count_footfalls(stepping(1.2, {{0.5, 0}, {1, 1}, {1.5, 0}, {2, 1}}));
  EXPECT_EQ(found.count, 3);
  EXPECT_EQ(found.same_foot, 0);
  EXPECT_EQ(found.quick, 0);
}

TEST(Footfalls, OfTheSameFootAndQuickOnesAreCounted) {
  const Footfalls found = count_footfalls(stepping(1.2, {{0.5, 0}, {1, 0}, {1.15, 1}, {1.5, 0}, {1.65, 0}}));
  EXPECT_EQ(found.count, 4);
  EXPECT_EQ(found.same_foot, 2);
  EXPECT_EQ(found.quick, 1);
}

TEST(Footfalls, OnTheSpotDoNotCount) {
  EXPECT_EQ(count_footfalls(stepping(0.4, {{0.5, 0}, {1, 0}, {1.5, 0}})).count, 0);
  EXPECT_EQ(count_footfalls(stepping(0.6, {{0.5, 0}, {1, 0}, {1.5, 0}})).same_foot, 2);
}

}  // namespace
}  // namespace fragmotion

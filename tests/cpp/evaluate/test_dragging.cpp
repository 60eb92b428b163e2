// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "evaluate/dragging.hpp"
#include "made_track.hpp"

namespace fragmotion {
namespace {

// Feet that are carried over the ground at 1 m/s for 2 s, so high.
BodyTrack carried(double height) {
  BodyTrack track = standing_track(2);
  move(track, true, [&](double t) { return Vector3(0, t, height); });
  return track;
}

TEST(Dragging, IsTheWayOfFeetThatAreLowerThanThoseOfTakesThatAreAsFast) {
  const FootClearance takes = clearance_of({standing_track(2), carried(0.1)});
  const Dragging low = dragging(carried(0.05), takes), high = dragging(carried(0.15), takes);
  EXPECT_NEAR(low.way, 4, 1e-9);  // of two feet
  EXPECT_NEAR(low.share(), 1, 1e-9);
  EXPECT_EQ(high.share(), 0);
  EXPECT_NEAR(dragging(carried(0.05), takes, 61).dragged, 2, 1e-9);
}

TEST(Dragging, IsNoneOfWhatStandsOrHasNoFeet) {
  const FootClearance takes = clearance_of({carried(0.1)});
  EXPECT_EQ(dragging(standing_track(2), takes).share(), 0);
  BodyTrack without = carried(0);
  without.feet = {};
  EXPECT_EQ(dragging(without, takes).share(), 0);
  EXPECT_EQ(clearance_of({without}).at(1), 0);
}

}  // namespace
}  // namespace fragmotion

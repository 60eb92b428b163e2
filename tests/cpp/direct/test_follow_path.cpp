// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "direct/follow_path.hpp"
#include "evaluate/performance.hpp"
#include "small_character.hpp"

namespace fragmotion {
namespace {

const Path kBend({{0, 0}, {0, 3}, {1, 4.5}, {3, 5}, {5, 5}});

TEST(FollowPath, IsPlayedAgainToTheBit) {
  Player player(gait_character()), other(gait_character());
  const CharacterFrame start = start_of(kBend);
  const PathWalk walk = follow_path(player, start, kBend, {}, 60, 60);
  other.reset(start);
  const Performance again = perform(other, walk.trace, 60);
  EXPECT_EQ(again.path[3 * (again.frames - 1)], other.frame().position.x());
  const Vector2 end = kBend.place(kBend.length());
  EXPECT_EQ((other.frame().position - end).norm(), walk.arrival_distance);
  double greatest = 0;
  for (int f = 1; f <= std::lround(walk.seconds * 60); ++f) {
    const Vector2 place{again.path[std::size_t{3} * f], again.path[std::size_t{3} * f + 1]};
    greatest = std::max(greatest, (kBend.place(kBend.nearest(place, 0, kBend.length())) - place).norm());
  }
  EXPECT_NEAR(greatest, walk.greatest_distance, 1e-12);
}

TEST(FollowPath, IsTheSameForTheSameSeedAtAnyRate) {
  for (const double rate : {24.0, 29.97, 60.0}) {
    Player one(gait_character()), other(gait_character());
    const PathWalk a = follow_path(one, start_of(kBend), kBend, {}, rate, 60),
                   b = follow_path(other, start_of(kBend), kBend, {}, rate, 60);
    ASSERT_EQ(a.trace.size(), b.trace.size());
    for (std::size_t i = 0; i < a.trace.size(); ++i) ASSERT_EQ(a.trace[i].y, b.trace[i].y);
    other.reset(start_of(kBend));
    perform(other, a.trace, rate);
    EXPECT_NEAR((other.frame().position - kBend.place(kBend.length())).norm(), a.arrival_distance, 1e-3) << rate;
  }
}

TEST(FollowPath, KeepsToThePathAndArrivesInTime) {
  for (const double arrive : {0.0, 6.0, 8.0}) {
    Player player(gait_character());
    FollowOptions options;
    options.arrive = arrive;
    const PathWalk walk = follow_path(player, start_of(kBend), kBend, options, 60, 60);
    EXPECT_TRUE(walk.arrived);
    EXPECT_LT(walk.mean_distance, 0.15);
    EXPECT_LT(walk.arrival_distance, kArrived);
    if (arrive > 0) {
      EXPECT_NEAR(walk.seconds, arrive, 0.25);
    }
  }
}

TEST(FollowPath, LastsAsLongAsItIsToldToWhereItDoesNotStop) {
  Player player(gait_character());
  FollowOptions options;
  options.end = PathEnd::loop;
  const PathWalk walk = follow_path(player, start_of(kBend), kBend, options, 60, 20);
  EXPECT_EQ(walk.trace.size(), 200U);
  EXPECT_TRUE(walk.arrived);
}

TEST(FollowPath, TellsWhatIsAskedTooMuch) {
  Player player(gait_character());
  FollowOptions options;
  options.arrive = 1;
  const PathWalk walk = follow_path(player, start_of(kBend), kBend, options, 60, 60);
  EXPECT_GT(walk.planned_seconds, 2);
  EXPECT_NEAR(walk.asked_speed, kBend.length(), 1e-9);
  EXPECT_TRUE(walk.arrived);
  EXPECT_THROW(follow_path(player, {}, kBend, {}, 0, 60), std::invalid_argument);
  EXPECT_THROW(follow_path(player, {}, kBend, {}, 60, 0), std::invalid_argument);
}

// Nothing that is tried again would get there, however short the path is.
TEST(FollowPath, IsTriedOnceWhereItCannotArriveInTime) {
  FollowOptions options;
  options.speed = 1e-300;
  Player player(gait_character());
  for (const double length : {50.0, 2.0}) {
    int begun = 0;
    const PathWalk walk = follow_path(player, {}, Path({{0, 0}, {0, length}}), options, 60, 60,
                                      [&](double, const std::string&) { return ++begun, true; });
    EXPECT_FALSE(walk.arrived);
    const int reports = 60 * 60 / 256;
    EXPECT_LE(begun, reports) << length;
  }
}

TEST(FollowPath, CanBeCancelled) {
  Player player(gait_character());
  EXPECT_THROW(
      follow_path(player, {}, Path({{0, 0}, {0, 50}}), {}, 60, 60, [](double, const std::string&) { return false; }),
      Cancelled);
}

}  // namespace
}  // namespace fragmotion

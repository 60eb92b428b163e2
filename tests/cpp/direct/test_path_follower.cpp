// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "allocations.hpp"
#include "direct/path_follower.hpp"

namespace fragmotion {
namespace {

constexpr double kTick = 0.1;

std::vector<Vector2> circle(double radius) {
  std::vector<Vector2> points;
  for (int i = 0; i < 100; ++i) {
    const double angle = 2 * kPi * i / 100;
    points.emplace_back(radius - radius * std::cos(angle), radius * std::sin(angle));
  }
  return points;
}

// A body that does what the control says, as fast as a body can.
struct Point {
  CharacterFrame frame;
  Vector2 velocity = Vector2::Zero();

  void go(const Control& control, double turn_rate, double seconds) {
    const int steps = 12;
    for (int i = 0; i < steps; ++i) {
      const double step = seconds / steps;
      frame.heading += control.turn * turn_rate * step;
      const Vector2 asked = Eigen::Rotation2Dd(frame.heading) * Vector2{control.x, control.y};
      velocity += clamp_length(asked - velocity, 5 * step);
      frame.position += velocity * step;
    }
  }
};

// Follows a path for some seconds; the places after each tick.
std::vector<CharacterFrame> follow(PathFollower& follower, const ControlSpace& space, CharacterFrame start,
                                   double seconds) {
  Point point{start};
  std::vector<CharacterFrame> frames{start};
  for (int i = 0; i < std::lround(seconds / kTick); ++i) {
    point.go(follower.steer(point.frame, kTick), space.turn_rate(), kTick);
    frames.push_back(point.frame);
  }
  return frames;
}

double off(double heading, double wanted) { return std::abs(std::remainder(heading - wanted, 2 * kPi)); }

TEST(PathFollower, KeepsToCirclesAtAnySpeedAndStopsAtTheirEnd) {
  const ControlSpace space;
  const Path path(circle(2), true);
  for (const double speed : {0.8, 1.2, 2.0, 3.3}) {
    PathFollower follower(space, path, {speed});
    for (const CharacterFrame& frame : follow(follower, space, start_of(path), 30))
      ASSERT_NEAR((frame.position - Vector2(2, 0)).norm(), 2, speed < 1.5 ? 0.1 : 0.25) << speed;
    EXPECT_TRUE(follower.stands());
    const auto frames = follow(follower, space, start_of(path), 0);
    EXPECT_NEAR(follower.way(), path.length(), 0.2);
  }
}

TEST(PathFollower, SteersAMirrorImageAsTheMirrorImageOfThePath) {
  const ControlSpace space;
  std::vector<Vector2> points{{0, 0}, {0.5, 2}, {2, 3}, {2, 5}, {-1, 6}}, images;
  for (const Vector2& p : points) images.emplace_back(-p.x(), p.y());
  PathFollower one((space), Path(points)), other((space), Path(images));
  Point point{{{0.3, -0.2}, 0.4}};
  for (int i = 0; i < 150; ++i) {
    const CharacterFrame image{{-point.frame.position.x(), point.frame.position.y()}, -point.frame.heading};
    const Control a = one.steer(point.frame, kTick), b = other.steer(image, kTick);
    ASSERT_NEAR(a.x, -b.x, 1e-9) << i;
    ASSERT_NEAR(a.y, b.y, 1e-9);
    ASSERT_NEAR(a.turn, -b.turn, 1e-9);
    point.go(a, space.turn_rate(), kTick);
  }
}

TEST(PathFollower, SteersAGiantAsItsModel) {
  constexpr double kSize = 4;
  const ControlSpace space, giants(space.walk() * kSize, space.run() * kSize, space.turn_rate(), 1 / kSize);
  std::vector<Vector2> points{{0, 0}, {0.5, 2}, {2, 3}, {2, 5}, {-1, 6}}, large;
  for (const Vector2& p : points) large.push_back(kSize * p);
  PathFollower one((space), Path(points)), other((giants), Path(large));
  Point point{start_of(Path(points))};
  for (int i = 0; i < 120; ++i) {
    const Control a = one.steer(point.frame, kTick),
                  b = other.steer({kSize * point.frame.position, point.frame.heading}, kTick);
    ASSERT_NEAR(kSize * a.x, b.x, 1e-6) << i;
    ASSERT_NEAR(kSize * a.y, b.y, 1e-6);
    point.go(a, space.turn_rate(), kTick);
  }
}

TEST(PathFollower, ArrivesAtTheTimeThatIsAsked) {
  const ControlSpace space;
  const Path path(circle(3), true);
  for (const double arrive : {8.0, 12.0, 18.0, 60.0}) {
    FollowOptions options;
    options.arrive = arrive;
    PathFollower follower(space, path, options);
    const auto frames = follow(follower, space, start_of(path), arrive + 5);
    const auto at = [&](double seconds) { return frames[std::lround(seconds / kTick)]; };
    EXPECT_LT((at(arrive).position - at(arrive + 5).position).norm(), 0.2) << arrive;
    EXPECT_GT((at(arrive - 0.8).position - at(arrive + 5).position).norm(), 0.1) << arrive;
  }
}

TEST(PathFollower, KeepsTheTimeOfARound) {
  const ControlSpace space;
  const Path path(circle(2), true);
  FollowOptions options;
  options.end = PathEnd::loop;
  options.arrive = 9;
  PathFollower follower(space, path, options);
  follow(follower, space, start_of(path), 10 * options.arrive);
  EXPECT_NEAR(follower.way(), 10 * path.length(), 0.4);
}

TEST(PathFollower, FacesWhereItIsToldTo) {
  const ControlSpace space;
  const Path path(circle(2), true);
  FollowOptions options;
  options.facing = PathFacing::heading;
  options.heading = 1;
  PathFollower fixed(space, path, options);
  for (const CharacterFrame& frame : follow(fixed, space, {{0, 0}, 1}, 8)) ASSERT_LT(off(frame.heading, 1), 0.05);
  options.facing = PathFacing::place;
  options.place = {2, 0};
  PathFollower inwards(space, path, options);
  const auto frames = follow(inwards, space, {{0, 0}, -kPi / 2}, 8);
  for (const CharacterFrame& frame : frames) {
    const Vector2 to = Vector2(2, 0) - frame.position;
    ASSERT_LT(off(frame.heading, std::atan2(-to.x(), to.y())), 0.3);
  }
}

TEST(PathFollower, LoopsAndGoesOn) {
  const ControlSpace space;
  FollowOptions options;
  options.end = PathEnd::loop;
  const Path line({{0, 0}, {0, 6}, {6, 6}});
  PathFollower loops(space, line, options);
  follow(loops, space, start_of(line), 60);
  EXPECT_GT(loops.way(), 50);
  options.end = PathEnd::go_on;
  PathFollower on(space, line, options);
  const auto frames = follow(on, space, start_of(line), 20);
  EXPECT_GT(frames.back().position.x(), 12);
  EXPECT_NEAR(frames.back().position.y(), 6, 0.1);
}

TEST(PathFollower, GoesToTheBeginningFirst) {
  const ControlSpace space;
  const Path line({{0, 0}, {0, 6}});
  PathFollower follower(space, line);
  const auto frames = follow(follower, space, {{4, 3}, 0}, 20);
  const bool came_by =
      std::any_of(frames.begin(), frames.end(), [](const CharacterFrame& f) { return f.position.norm() < 0.6; });
  EXPECT_TRUE(came_by);
  EXPECT_LT((frames.back().position - Vector2(0, 6)).norm(), 0.2);
}

TEST(PathFollower, SlowsDownForCornersAndNeverAsksForMoreThanARun) {
  const ControlSpace space;
  const Path corner({{0, 0}, {0, 10}, {10, 10}, {10, 10.001}, {0, 10.001}});
  PathFollower follower(space, corner, {1000});
  Point point{start_of(corner)};
  double least = 10;
  for (int i = 0; i < 200; ++i) {
    const Control control = follower.steer(point.frame, kTick);
    ASSERT_LE(control.speed(), space.run() + 1e-9);
    if ((point.frame.position - Vector2(0, 10)).norm() < 0.3) least = std::min(least, control.speed());
    point.go(control, space.turn_rate(), kTick);
  }
  EXPECT_LT(least, 2);
  EXPECT_LT((point.frame.position - Vector2(0, 10)).norm(), 0.25) << "it came back from the cusp";
}

TEST(PathFollower, SteersWithoutAllocating) {
  const ControlSpace space;
  FollowOptions options;
  options.arrive = 20;
  PathFollower follower(space, Path(circle(2), true), options);
  Point point;
  const std::size_t before = allocations;
  for (int i = 0; i < 100; ++i) point.go(follower.steer(point.frame, kTick), space.turn_rate(), kTick);
  EXPECT_EQ(allocations, before);
}

TEST(PathFollower, BeginsAgainAsAtFirst) {
  const ControlSpace space;
  PathFollower follower(space, Path(circle(2), true));
  const auto first = follow(follower, space, {}, 12);
  follower.reset();
  const auto again = follow(follower, space, {}, 12);
  for (std::size_t i = 0; i < first.size(); ++i) ASSERT_EQ(first[i].position, again[i].position);
}

TEST(PathFollower, RefusesWhatIsOutOfRange) {
  const ControlSpace space;
  const Path line({{0, 0}, {0, 6}});
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto with = [](auto FollowOptions::*member, auto value) {
    FollowOptions options;
    options.*member = value;
    return options;
  };
  EXPECT_THROW(PathFollower(space, line, with(&FollowOptions::speed, -1.0)), std::invalid_argument);
  EXPECT_THROW(PathFollower(space, line, with(&FollowOptions::arrive, nan)), std::invalid_argument);
  EXPECT_THROW(PathFollower(space, line, with(&FollowOptions::heading, nan)), std::invalid_argument);
  EXPECT_THROW(PathFollower(space, line, with(&FollowOptions::place, Vector2(nan, 0))), std::invalid_argument);
  PathFollower follower(space, line);
  EXPECT_THROW(follower.steer({{nan, 0}, 0}, 0.1), std::invalid_argument);
  EXPECT_THROW(follower.steer({}, -1), std::invalid_argument);
}

}  // namespace
}  // namespace fragmotion

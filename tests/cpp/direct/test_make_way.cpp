// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <utility>

#include "allocations.hpp"
#include "direct/make_way.hpp"

namespace fragmotion {
namespace {

constexpr double kStep = 1.0 / 30, kMost = 2, kRadius = 0.3;

double off_by(const Clearance& clearance, const Vector2& velocity) {
  double off = 0;
  for (int i = 0; i < clearance.count; ++i) {
    off = std::max(off, -(velocity - clearance.planes[i].point).dot(clearance.planes[i].normal));
  }
  return off;
}

// Each of many velocities in the circle of the fastest.
template <typename Each>
void each_velocity(const Each& each) {
  constexpr int kFine = 120;
  for (int x = -kFine; x <= kFine; ++x) {
    for (int y = -kFine; y <= kFine; ++y) {
      const Vector2 velocity = kMost / kFine * Vector2{x, y};
      if (velocity.norm() <= kMost) each(velocity);
    }
  }
}

std::vector<Walker> walkers_at_random(std::mt19937& random, int count, double field) {
  const auto draw = [&](double most) { return most * (2.0 * random() / std::mt19937::max() - 1); };
  std::vector<Walker> walkers;
  for (int i = 0; i < count; ++i) {
    walkers.push_back({{draw(field), draw(field)}, {draw(1.4), draw(1.4)}, kRadius, random() % 8 != 0});
  }
  return walkers;
}

// By brute force over a grid of velocities, of those who have room and of those who have none.
TEST(Clearance, IsNextToWhatIsWantedOrOffByTheLeast) {
  std::mt19937 random(1);
  const double fine = 2 * kMost / 120;
  int tight = 0;
  for (int round = 0; round < 60; ++round) {
    MakeWay way;
    way.look(walkers_at_random(random, 9, round % 2 == 0 ? 1.5 : 3));
    const Clearance clearance = way.clearance(0, kStep);
    ASSERT_EQ(clearance.count, 8);
    const Vector2 wanted{1.4, 0.3}, found = clearance.nearest(wanted, kMost);
    double best = std::numeric_limits<double>::infinity(), least = best;
    each_velocity([&](const Vector2& velocity) {
      const double off = off_by(clearance, velocity);
      least = std::min(least, off);
      if (off == 0) best = std::min(best, (velocity - wanted).norm());
    });
    EXPECT_LE(found.norm(), kMost + 1e-9);
    if (std::isinf(best)) {
      EXPECT_LE(off_by(clearance, found), least + 1e-4) << round;
      ++tight;
    } else {
      EXPECT_LE(off_by(clearance, found), 1e-4) << round;
      EXPECT_LE((found - wanted).norm(), best + 1e-4) << round;
      EXPECT_GE((found - wanted).norm(), best - fine - 0.2) << round;
    }
  }
  EXPECT_GT(tight, 3);
  EXPECT_LT(tight, 57);
}

// Pressed against a wall from three sides: the others are off, the wall is not.
TEST(Clearance, IsOffForOthersRatherThanForWhatStandsThere) {
  MakeWay way;
  const double near = 1.5 * kRadius;
  way.look({{{0, 0}, {0, 0}, kRadius, true},
            {{0, near}, {0, -1}, kRadius, true},
            {{-near, near}, {0.5, -1}, kRadius, true},
            {{near, near}, {-0.5, -1}, kRadius, true}});
  Clearance clearance = way.clearance(0, kStep);
  ASSERT_LT(clearance.nearest(Vector2::Zero(), kMost).y(), -0.1) << "they press";
  const HalfPlane wall{Vector2::Zero(), Vector2::UnitY()};
  clearance.add(wall);
  const Vector2 found = clearance.nearest(Vector2::Zero(), kMost);
  EXPECT_GE((found - wall.point).dot(wall.normal), -1e-9);
}

// Of those around, as brute force finds them: all whom the grid could miss are too far away to matter.
TEST(MakeWay, SeesTheNearest) {
  std::mt19937 random(2);
  const std::vector<Walker> walkers = walkers_at_random(random, 300, 12);
  MakeWay way, alone;
  way.look(walkers);
  for (std::size_t one = 0; one < walkers.size(); one += 7) {
    std::vector<std::size_t> near;
    for (std::size_t i = 0; i < walkers.size(); ++i) near.push_back(i);
    const auto square = [&](std::size_t i) { return (walkers[i].place - walkers[one].place).squaredNorm(); };
    std::sort(near.begin(), near.end(), [&](std::size_t a, std::size_t b) { return square(a) < square(b); });
    std::vector<Walker> few;
    for (int i = 0; i <= Clearance::kMost; ++i) few.push_back(walkers[near[i]]);
    alone.look(few);
    const Clearance expected = alone.clearance(0, kStep), found = way.clearance(one, kStep);
    ASSERT_EQ(found.count, Clearance::kMost);
    for (int i = 0; i < found.count; ++i) EXPECT_EQ(found.planes[i].point, expected.planes[i].point) << one;
  }
}

// Two hundred on a circle who all go to the other side: they meet in the middle.
TEST(MakeWay, LetsNobodyTouchAnotherWhoDoesAsIsSaid) {
  constexpr int kCount = 200;
  std::vector<Walker> walkers;
  std::vector<Vector2> goals;
  for (int i = 0; i < kCount; ++i) {
    const double angle = 2 * 3.14159265358979 * i / kCount;
    const Vector2 place = 25 * Vector2{std::cos(angle), std::sin(angle)};
    walkers.push_back({place, Vector2::Zero(), kRadius, true});
    goals.push_back(-place);
  }
  MakeWay way;
  way.look(walkers);
  const std::size_t before = allocations;
  double nearest = 1e9, left = 0;
  for (int step = 0; step < 3000; ++step) {
    way.look(walkers);
    left = 0;
    for (int i = 0; i < kCount; ++i) {
      const Vector2 to_go = goals[i] - walkers[i].place;
      walkers[i].velocity = way.clearance(i, kStep).nearest(clamp_length(to_go, 1.4), 1.6);
      left = std::max(left, to_go.norm());
    }
    for (Walker& walker : walkers) walker.place += kStep * walker.velocity;
    for (int i = 0; step % 3 == 0 && i < kCount; ++i) {
      for (int j = 0; j < i; ++j) nearest = std::min(nearest, (walkers[i].place - walkers[j].place).norm());
    }
  }
  EXPECT_EQ(allocations, before);
  EXPECT_GT(nearest, 0.9 * 2 * kRadius) << "where there is no room, too";
  EXPECT_LT(left, 0.5) << "all have come to the other side";
}

TEST(MakeWay, PartsThoseWhoStandInOnePlace) {
  std::vector<Walker> walkers(2);
  for (Walker& walker : walkers) walker.radius = kRadius;
  MakeWay way;
  way.look(walkers);
  const Vector2 a = way.clearance(0, 0.5).nearest(Vector2::Zero(), kMost),
                b = way.clearance(1, 0.5).nearest(Vector2::Zero(), kMost);
  EXPECT_NEAR((a - b).norm() * 0.5, 2 * kRadius, 1e-6);
}

TEST(MakeWay, GoesAllOfTheWayForWhoDoesNotYield) {
  std::vector<Walker> walkers{{{0, 0}, {0, 1.4}, kRadius, true}, {{0.1, 4}, {0, -1.4}, kRadius, false}};
  MakeWay way;
  const Vector2 wanted{0, 1.4};
  way.look(walkers);
  const double whole = (way.clearance(0, kStep).nearest(wanted, kMost) - wanted).norm();
  walkers[1].yields = true;
  way.look(walkers);
  EXPECT_NEAR((way.clearance(0, kStep).nearest(wanted, kMost) - wanted).norm(), whole / 2, 1e-9);
}

// Who stays sees what the other one wants, who goes sees what he does.
TEST(MakeWay, IsAskedToByWhatIsWanted) {
  std::vector<Walker> walkers{{{0, 0}, {0, 0}, kRadius, true}, {{0.1, 1}, {0, 0}, kRadius, true}};
  walkers[1].wish = {0, -1.4};
  const auto made_way = [&](bool stays) {
    walkers[0].stays = stays;
    MakeWay way;
    way.look(walkers);
    return way.clearance(0, kStep).nearest(Vector2::Zero(), kMost).norm();
  };
  EXPECT_EQ(made_way(false), 0);
  const double stepped = made_way(true);
  EXPECT_GT(stepped, 0.1);
  walkers[1].velocity = std::exchange(walkers[1].wish, Vector2::Zero());
  EXPECT_EQ(made_way(false), stepped);
}

// Held up wholly for ten seconds one asks for nothing any more, and again after standing as long, but not while others
// press.
TEST(WayRound, AsksUntilItsPatienceEnds) {
  const Vector2 wanted{0, 1.4};
  MakeWay way;
  way.look({{{0, 0}, {0, 0}, kRadius, true}, {{0, 2 * kRadius}, {0, 0}, kRadius, false}});
  const Clearance free, blocked = way.clearance(0, kStep);
  way.look({{{0, 0}, {0, 0}, kRadius, true}, {{0, 1.5 * kRadius}, {0, 0}, kRadius, false}});
  const Clearance pressed = way.clearance(0, kStep);
  WayRound round;
  const auto spend = [&](const Clearance& clearance, const Vector2& asked, double seconds) {
    for (int step = 0; step < std::lround(seconds / kStep); ++step) round.choose(clearance, asked, kMost, kStep);
  };
  const auto wish = [&] {
    Walker walker{{0, 0}, {0, 0}, kRadius};
    round.choose(blocked, wanted, kMost, 0);
    round.show(walker);
    EXPECT_FALSE(walker.stays);
    return walker.wish.norm() / wanted.norm();
  };
  EXPECT_EQ(wish(), 1);
  spend(blocked, wanted, 60);
  EXPECT_NEAR(wish(), 0, 1e-9);
  spend(pressed, Vector2::Zero(), 5);
  EXPECT_NEAR(wish(), 0, 1e-9);
  spend(free, Vector2::Zero(), 5);
  EXPECT_NEAR(wish(), 0.5, 1e-9);
  spend(free, wanted, 5);
  EXPECT_NEAR(wish(), 1, 1e-9);
  round.choose(free, Vector2::Zero(), kMost, kStep);
  Walker walker{{0, 0}, {0, 0}, kRadius};
  round.show(walker);
  EXPECT_TRUE(walker.stays);
}

}  // namespace
}  // namespace fragmotion

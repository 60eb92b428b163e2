// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "allocations.hpp"
#include "control/simulated_players.hpp"
#include "feet/ground_follower.hpp"
#include "runtime/player.hpp"
#include "small_character.hpp"

namespace fragmotion {
namespace {

constexpr double kStep = 1.0 / 60;
const double kSlope = std::tan(20 * kPi / 180);

Ground level(double height) {
  return [height](const Vector3&) { return GroundPoint{height, Vector3::UnitZ()}; };
}

GroundPoint up_along_y(const Vector3& from) { return {kSlope * from.y(), {0, -kSlope, 1}}; }

GroundPoint stairs(const Vector3& from) { return {0.18 * std::floor(from.y() / 0.3), Vector3::UnitZ()}; }

struct Shown {
  std::vector<Vector3> roots;
  std::vector<std::vector<double>> rotations;
  double missed = 0;
};

// An explorer's half minute, from a heading.
Shown play(const Ground& ground, double heading = 0, std::uint64_t seed = 1) {
  PlayerOptions options;
  options.seed = seed;
  Player player(gait_character(), options);
  player.stand_on(ground);
  player.reset({{0, 0.1}, heading});
  Shown shown;
  for (const Control& control : simulate_trace("explorer", 30, 5, player.character().space)) {
    for (int i = 0; i < 6; ++i) {
      player.step(control, kStep);
      shown.roots.push_back(player.root_position());
      shown.rotations.push_back(player.rotations());
    }
  }
  shown.missed = player.ground_missed();
  return shown;
}

TEST(GroundFollower, ShowsOnLevelGroundToTheBitWhatIsShownWithoutGround) {
  const Shown without = play({}), on = play(level(0));
  EXPECT_EQ(without.roots, on.roots);
  EXPECT_EQ(without.rotations, on.rotations);
}

TEST(GroundFollower, IsLiftedOnAHigherLevelAndOtherwiseTheSame) {
  const Shown without = play({}), on = play(level(1));
  EXPECT_EQ(without.rotations, on.rotations);
  for (std::size_t f = 0; f < on.roots.size(); ++f)
    EXPECT_LT((on.roots[f] - without.roots[f] - Vector3{0, 0, 1}).norm(), 1e-12);
}

TEST(GroundFollower, GoesOnGroundThatIsLevelButForRoundingAsWithoutGround) {
  const Ground rounded = [](const Vector3& from) {
    return GroundPoint{1e-6 * std::sin(50 * from.x() + 70 * from.y()), Vector3::UnitZ()};
  };
  const Shown without = play({}), on = play(rounded);
  for (std::size_t f = 0; f < on.roots.size(); ++f) EXPECT_LT((on.roots[f] - without.roots[f]).norm(), 1e-4) << f;
}

TEST(GroundFollower, GoesTheSameWayOnTheSlopeAndIsTheSameEveryTime) {
  const Shown without = play({}), on = play(up_along_y), again = play(up_along_y);
  EXPECT_EQ(on.rotations, again.rotations);
  double highest = 0;
  for (std::size_t f = 0; f < on.roots.size(); ++f) {
    EXPECT_EQ(on.roots[f].head<2>(), without.roots[f].head<2>());
    highest = std::max(highest, std::abs(on.roots[f].z() - without.roots[f].z() - kSlope * on.roots[f].y()));
  }
  EXPECT_LT(highest, 0.5) << "the hips follow the slope";
}

TEST(GroundFollower, LooksTheSameOnASlopeThatIsTurnedWithTheCharacter) {
  const Shown up = play(up_along_y);
  const Ground turned = [](const Vector3& from) { return GroundPoint{-kSlope * (from.x() - 0.1), {kSlope, 0, 1}}; };
  Player player(gait_character());
  player.stand_on(turned);
  player.reset({{0, 0.1}, kPi / 2});
  std::size_t f = 0;
  for (const Control& control : simulate_trace("explorer", 2, 5, player.character().space)) {
    for (int i = 0; i < 6; ++i, ++f) {
      player.step(control, kStep);
      EXPECT_NEAR(player.root_position().z() - kSlope * 0.2, up.roots[f].z() - kSlope * 0.1, 0.1);
    }
  }
}

TEST(GroundFollower, StaysWithinABodysReachOfTheGroundItIsOver) {
  for (const Ground& ground : {Ground(up_along_y), Ground(stairs)}) {
    const Shown without = play({}), on = play(ground);
    for (std::size_t f = 0; f < on.roots.size(); ++f) {
      const double over = on.roots[f].z() - ground(on.roots[f])->height;
      ASSERT_GT(over, 0.2) << f;
      ASSERT_LT(over, without.roots[f].z() + 0.6) << f;
    }
  }
}

TEST(GroundFollower, LiftsNoFootOverTheHipsForAWallThatReachesToTheKnees) {
  const Ground walls = [](const Vector3& from) {
    const double along = from.y() - 1.5 * std::floor(from.y() / 1.5);
    return GroundPoint{along > 1 && along < 1.1 ? 0.4 : 0, Vector3::UnitZ()};
  };
  const Skeleton& skeleton = gait_character()->pool.skeleton;
  const Kinematics kinematics(skeleton);
  PosedBones posed(kinematics.bones());
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    const Shown shown = play(walls, 0, seed);
    for (std::size_t f = 0; f < shown.roots.size(); ++f) {
      kinematics.world(shown.roots[f], shown.rotations[f].data(), posed.heads.data(), posed.rotations.data());
      for (const int foot : {skeleton.roles.left_foot, skeleton.roles.right_foot})
        EXPECT_LT(posed.heads[foot].z(), shown.roots[f].z()) << f << ", seed " << seed;
    }
  }
}

// The furthest that a thigh turns in a step, rad.
double furthest_turn(const Shown& shown) {
  const Skeleton& skeleton = gait_character()->pool.skeleton;
  const Kinematics kinematics(skeleton);
  PosedBones now(kinematics.bones()), before = now;
  double furthest = 0;
  for (std::size_t f = 0; f < shown.roots.size(); ++f, std::swap(now, before)) {
    kinematics.world(shown.roots[f], shown.rotations[f].data(), now.heads.data(), now.rotations.data());
    for (const int thigh : {skeleton.roles.left_thigh, skeleton.roles.right_thigh}) {
      if (f > 0) furthest = std::max(furthest, now.rotations[thigh].angularDistance(before.rotations[thigh]));
    }
  }
  return furthest;
}

TEST(GroundFollower, WhipsNoLegAboutItsHipOnStairs) {
  const double on_plane = furthest_turn(play({}));
  for (const double heading : {0.0, 0.7, kPi / 2, kPi}) EXPECT_LT(furthest_turn(play(stairs, heading)), 2.5 * on_plane);
}

// The most times that a step asks for the ground, in half a minute; `restless`: an explorer, and not straight on.
int most_asked(const Ground& ground, double heading, double seconds, bool restless) {
  int asked = 0, most = 0, all = 0;
  Player player(gait_character());
  const ControlSpace& space = player.character().space;
  Trace trace = simulate_trace("explorer", 30, 5, space);
  for (std::size_t i = 0; i < trace.size() && !restless; ++i)
    trace[i] = {0, i < 150 ? space.walk() : space.run(), 0, 0};
  player.reset({{0, 0.1}, heading});
  player.stand_on([&](const Vector3& from) {
    ++asked;
    return ground(from);
  });
  for (const Control& control : trace) {
    for (double rest = 0.1; rest > 1e-9; rest -= seconds) {
      asked = 0;
      player.step(control, seconds);
      most = std::max(most, asked);
      all += asked;
    }
  }
  EXPECT_GT(all, 300);
  return most;
}

TEST(GroundFollower, AsksForTheGroundAtMostEightTimesAStep) {
  const Ground low =
                   [](const Vector3&from) {
                     return GroundPoint{0.17 * std::floor(from.y() / 0.3), {0, 0, 1}};
                   },
               rough = [](const Vector3&from) {
                 return GroundPoint{0.08 * std::sin(7 * from.x()) * std::cos(9 * from.y()), {0.2, 0.1, 1}};
               };
  for (const Ground& ground : {Ground(up_along_y), Ground(stairs), low, rough, level(1)}) {
    for (const double heading : {0.0, kPi / 3, kPi}) {
      for (const bool restless : {false, true}) {
        EXPECT_LE(most_asked(ground, heading, kStep, restless), 8);
        EXPECT_LE(most_asked(ground, heading, 0.1, restless), 8);
      }
    }
  }
}

TEST(GroundFollower, TellsHowLongThereWasNoGroundAndKeepsItsHeight) {
  const Ground none = [](const Vector3&) { return std::nullopt; };
  const Shown without = play({}), on = play(none);
  EXPECT_NEAR(on.missed, 30, 0.1);
  EXPECT_EQ(without.rotations, on.rotations);
  EXPECT_EQ(without.roots, on.roots);
  EXPECT_EQ(play(level(2)).missed, 0);
}

TEST(GroundFollower, TakesNoNumbersThatAreNone) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const GroundPoint& broken :
       {GroundPoint{nan, Vector3::UnitZ()}, GroundPoint{0, {0, nan, 1}}, GroundPoint{1e300, Vector3::UnitZ()},
        GroundPoint{-1e300, Vector3::UnitZ()}, GroundPoint{0, Vector3::Zero()}, GroundPoint{0, {0, 1e300, 1e300}}}) {
    const Shown on = play([broken](const Vector3&) { return broken; });
    EXPECT_NEAR(on.missed, 30, 0.1);
    for (const Vector3& root : on.roots) ASSERT_TRUE(root.allFinite());
  }
}

TEST(GroundFollower, ShowsPosesOnGroundThatIsNoise) {
  const Ground noise = [](const Vector3& from) {
    const double bump = std::sin(37 * from.x()) * std::cos(41 * from.y());
    return GroundPoint{0.3 * bump, {bump, -bump, 0.01}};
  };
  const Shown on = play(noise);
  for (const std::vector<double>& rotations : on.rotations) {
    for (std::size_t b = 0; b < rotations.size(); b += 4) ASSERT_NEAR(load_quaternion(&rotations[b]).norm(), 1, 1e-6);
  }
  for (const Vector3& root : on.roots) ASSERT_LT(std::abs(root.z()), 3);
}

TEST(GroundFollower, AllocatesNothing) {
  Player player(gait_character());
  player.stand_on(stairs);
  const Trace trace = simulate_trace("explorer", 10, 3, player.character().space);
  const std::size_t before = allocations;
  for (const Control& control : trace) player.step(control, 0.1);
  EXPECT_EQ(allocations, before);
}

constexpr int kMany = 1000;

TEST(PlaneUnder, IsOnTheHighestGroundUnderASole) {
  const Sole sole{{0, 0.2, 0}, {0, 0.32, 0}, {0, 0.38, 0}};
  const Ground steps = stairs, slope = up_along_y;
  const auto under = [&](const Ground& ground) {
    GroundProbe probe(ground, 1, 3);
    std::array<std::optional<Footing>, 3> points;
    for (std::size_t i = 0; i < 3; ++i) points[i] = probe.at(sole.points()[i].head<2>());
    EXPECT_FALSE(probe.may_ask());
    return plane_under(sole, points);
  };
  const auto footing = under(steps);
  ASSERT_TRUE(footing);
  EXPECT_DOUBLE_EQ(footing->height, 0.18);
  EXPECT_TRUE(footing->slope.isZero(0));
  const auto sloping = under(slope);
  ASSERT_TRUE(sloping);
  EXPECT_NEAR(sloping->height, 0.32 * kSlope, 1e-12);
  EXPECT_NEAR(sloping->slope.y(), kSlope, 1e-12);
  EXPECT_FALSE(under([](const Vector3&) { return std::nullopt; }));
}

TEST(KnownGround, FindsEdgesUnderASoleAndNoneOnASlope) {
  const auto edges = [](const Ground& ground, const Sole& sole) {
    GroundProbe probe(ground, 1, kMany);
    return KnownGround().edges(sole, probe);
  };
  const Ground steps = stairs, slope = up_along_y;
  const Sole free{{0, 0.36, 0}, {0, 0.48, 0}, {0, 0.54, 0}}, low{{0, 0.44, 0}, {0, 0.56, 0}, {0, 0.62, 0}};
  EXPECT_EQ(edges(steps, free), 0);
  EXPECT_GE(edges(steps, low), KnownGround::kInTheWay) << "its tip is in the next step";
  EXPECT_EQ(edges(slope, low), 0);
  const Sole up{{0, 0.24, 0}, {0, 0.36, 0}, {0, 0.42, 0}};
  const double over = edges(steps, up);
  EXPECT_TRUE(over > 0 && over < KnownGround::kInTheWay) << "a heel over the edge";
  const Sole down{{0, 0.54, 0}, {0, 0.42, 0}, {0, 0.36, 0}};
  EXPECT_EQ(edges(steps, down), 0);
}

TEST(KnownGround, AsksForNoPlaceBetweenTwoOnOnePlane) {
  const Ground steps = stairs;
  GroundProbe probe(steps, 1, 4);
  KnownGround known;
  const KnownGround::Along along{{0, 1}, 0.01};
  known.ask({0, 0.1}, probe);
  known.ask({0, 0.2}, probe);
  known.ask({0, 0.32}, probe);
  EXPECT_EQ(known.at({0, 0.15}, along, probe)->height, 0);
  EXPECT_TRUE(probe.may_ask());
  EXPECT_EQ(known.at({0, 0.29}, along, probe)->height, 0) << "it is asked for: there is an edge between";
  EXPECT_FALSE(probe.may_ask());
  EXPECT_EQ(known.at({0, 0.298}, along, probe)->height, 0) << "as the nearest that is known";
  EXPECT_EQ(known.at({0, 0.5}, along, probe)->height, 0.18);
  known.forget();
  EXPECT_FALSE(known.at({0, 0.15}, along, probe));
}

// A foot over stairs that is on level ground at a place, and lands there in a time.
FootAhead foot_at(double y, double due, double landing) {
  FootAhead foot;
  foot.stands = due == 0;
  foot.due = due;
  foot.now = Sole{{0, -0.12, 0}, {0, 0, 0}, {0, 0.06, 0}}.moved({0, y});
  for (std::size_t i = 0; i < FootAhead::kPoints; ++i)
    foot.way[i] = foot.now.moved({0, (landing - y) * static_cast<double>(i + 1) / FootAhead::kPoints});
  return foot;
}

TEST(FootOnGround, IsOnTheTreadThatWasForeseenWhenItLands) {
  const Ground steps = stairs;
  GroundProbe probe(steps, 5, kMany);
  FootOnGround foot;
  foot.advance(foot_at(0.16, 0, 0.16), 0, 0, probe, 0);
  EXPECT_DOUBLE_EQ(foot.height(), 0);
  for (int i = 1; i < 30; ++i) {
    foot.advance(foot_at(0.16 + 0.02 * i, (30 - i) * kStep, 0.76), 0, kStep, probe, 0);
    const double y = 0.16 + 0.02 * i + foot.shift().y();
    EXPECT_GE(foot.height() + 1e-9, stairs({0, y, 0}).height) << "it goes over the steps";
  }
  foot.advance(foot_at(0.76, 0, 0.76), 0, kStep, probe, 0);
  EXPECT_NEAR(foot.height(), 0.36, 0.02);
  for (int i = 0; i < 5; ++i) foot.advance(foot_at(0.76, 0, 0.76), 0, kStep, probe, 0);
  EXPECT_NEAR(foot.height(), 0.36, 0.001);
  EXPECT_TRUE(foot.slope().isZero(1e-6));
}

TEST(FootOnGround, ComesDownQuicklyWhereItsLandingWasNotForeseen) {
  const Ground steps = stairs;
  GroundProbe probe(steps, 5, kMany);
  FootOnGround foot;
  foot.advance(foot_at(0.16, 0, 0.16), 0, 0, probe, 0);
  for (int i = 1; i < 15; ++i) foot.advance(foot_at(0.16 + 0.02 * i, (30 - i) * kStep, 0.76), 0, kStep, probe, 0);
  double last = foot.height();
  for (int i = 0; i < 6; ++i) {
    foot.advance(foot_at(0.46, 0, 0.46), 0, kStep, probe, 0);
    EXPECT_LT(std::abs(foot.height() - last), 5 * kStep) << "no faster than a foot goes";
    last = foot.height();
  }
  EXPECT_NEAR(last, 0.18, 0.01);
}

TEST(FootOnGround, GoesOnFromItsHeightWhenItIsToLandNearerThanWasForeseen) {
  const Ground wall = [](const Vector3& from) {
    return GroundPoint{from.y() > 0.5 && from.y() < 0.55 ? 0.4 : 0, Vector3::UnitZ()};
  };
  GroundProbe probe(wall, 5, kMany);
  FootOnGround foot;
  foot.advance(foot_at(0.16, 0, 0.16), 0, 0, probe, 0);
  for (int i = 1; i < 22; ++i) foot.advance(foot_at(0.16 + 0.02 * i, (30 - i) * kStep, 0.76), 0, kStep, probe, 0);
  const double before = foot.height();
  EXPECT_GT(before, 0.4);
  foot.advance(foot_at(0.6, 0.1, 0.65), 0, kStep, probe, 0);
  EXPECT_LT(std::abs(foot.height() - before), 5 * kStep) << "no faster than a foot goes";
}

TEST(HipsOnGround, GoUpASlopeAsThePlaneDoesAndOverStairsWithoutAKink) {
  for (const Ground& ground : {Ground(up_along_y), Ground(stairs)}) {
    GroundProbe probe(ground, 50, 240 * kMany);
    FeetOnGround feet;
    HipsOnGround hips;
    double before = 0, speed = 0;
    for (int i = 0; i < 240; ++i) {
      for (int side = 0; side < 2; ++side) {  // steps of 0.6 m in half a second each, in turn
        const int phase = i + 30 * side, step = phase / 60;
        const double from = 1.2 * step - 0.6 * side, part = std::max(0, phase % 60 - 30) / 30.0;
        feet[side].advance(foot_at(from + 1.2 * part, part > 0 ? (1 - part) * 0.5 : 0, from + (part > 0 ? 1.2 : 0)), 0,
                           i > 0 ? kStep : 0, probe, 0);
      }
      const double y = 1.2 * i * kStep;
      hips.advance({0, y}, feet, i > 0 ? kStep : 0);
      if (i > 20) {
        const double now = (hips.level() - before) / kStep;
        if (i > 21) EXPECT_LT(std::abs(now - speed) / kStep, 12) << i << " m/s^2";
        speed = now;
      }
      before = hips.level();
      EXPECT_NEAR(hips.level(), ground({0, y, 50})->height, 0.3) << i;
    }
  }
}

// Lengths are shares of the body's own, and time is that of the takes: what falls in them falls as much faster as the
// body is larger.
TEST(GroundFollower, GoesTheSameInEverySizeOnStairsOfThatSize) {
  const auto shown = [](double size) {
    BuildOptions options;
    options.classes = 20, options.restarts = 1;
    const ControlSpace space(1.2 * size, 3.3 * size);
    const auto character = std::make_shared<const Character>(
        build(humanoid(size), gait_takes(30, size), {simulate_trace("walker", 30, 2, space)}, options));
    Player player(character);
    player.stand_on([size](const Vector3& from) {
      return GroundPoint{size * stairs(from / size).height, Vector3::UnitZ()};
    });
    player.reset({{0, 0.1 * size}, 0});
    Shown shown;
    for (const Control& control : simulate_trace("explorer", 10, 5, character->space)) {
      for (int i = 0; i < 6; ++i) {
        player.step(control, kStep);
        shown.roots.push_back(player.root_position() / size);
        shown.rotations.push_back(player.rotations());
      }
    }
    return shown;
  };
  const Shown man = shown(1);
  for (const double size : {0.125, 8.0}) {  // powers of two: no rounding decides between equals
    const Shown other = shown(size);
    for (std::size_t f = 0; f < man.roots.size(); ++f) {
      ASSERT_LT((other.roots[f] - man.roots[f]).norm(), 1e-6) << size << " at " << f;
      for (std::size_t i = 0; i < man.rotations[f].size(); ++i)
        ASSERT_NEAR(other.rotations[f][i], man.rotations[f][i], 1e-6) << size << " at " << f;
    }
  }
}

}  // namespace
}  // namespace fragmotion

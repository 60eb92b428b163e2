// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "allocations.hpp"
#include "looking.hpp"
#include "runtime/player.hpp"

namespace fragmotion {
namespace {

constexpr double kReachFrame = 1.0 / 60;
constexpr Control kStandsThere{0, 0, 0, 0}, kWalksBy{0, 1.2, 0, 0};

// What is seen of a player from outside: the oracle.
struct Handed {
  Player player{looking_character()};
  std::array<ArmRange, 2> ranges = arm_ranges({&looking_character()->pool});
  Kinematics kinematics{looking_character()->pool.skeleton};
  PosedBones posed{kinematics.bones()};

  void step(const Control& control = kStandsThere, double seconds = kReachFrame) {
    player.step(control, seconds);
    kinematics.world(player.root_position(), player.rotations().data(), posed.heads.data(), posed.rotations.data());
  }
  void play(double seconds, const Control& control = kStandsThere) {
    for (double time = 0; time < seconds; time += kReachFrame) step(control);
  }
  const Skeleton& skeleton() const { return kinematics.skeleton(); }
  Vector3 hand(int side) const { return palm(skeleton(), ranges[side].arm, posed); }
  double length(int side) const { return arm_length(skeleton(), ranges[side].arm, posed); }
  Vector3 shoulder(int side) const { return posed.heads[ranges[side].arm.upper]; }
  CharacterFrame frame() const {
    return {player.root_position().head<2>(), kinematics.frame(posed.heads[0], posed.rotations[0]).heading};
  }
  // A place so far from the shoulder, in lengths of the arm.
  Vector3 place(int side, const Vector3& way, double distance) const {
    return shoulder(side) + frame().rotation() * way.normalized() * distance * length(side);
  }
  double bend(int side) const {
    const Arm& arm = ranges[side].arm;
    const Vector3 upper = posed.heads[arm.elbow] - posed.heads[arm.upper], lower = hand(side) - posed.heads[arm.elbow];
    return std::acos(std::clamp(upper.normalized().dot(lower.normalized()), -1.0, 1.0));
  }
};

TEST(ArmRange, KnowsShoulderElbowAndHand) {
  const std::array<Arm, 2> arms = resting_arms(humanoid());
  EXPECT_EQ(arms[0].upper, humanoid().find("upper_arm.L"));
  EXPECT_EQ(arms[0].elbow, humanoid().find("forearm.L"));
  EXPECT_EQ(arms[1].upper, humanoid().find("upper_arm.R"));
  EXPECT_EQ(arms[1].hand, humanoid().find("hand.R"));
  EXPECT_FALSE(resting_arms(tiny_skeleton())[0].exists());
}

TEST(Reaching, IsThereFromWhereverItIsInReach) {
  for (const int side : {0, 1}) {
    const double out = side == 0 ? -1 : 1;
    for (const Vector3& way : {Vector3{0, 1, 0}, Vector3{out, 1, 0.3}, Vector3{out, 0.2, 1}, Vector3{-0.4 * out, 1, 0},
                               Vector3{out, 0, -0.5}, Vector3{0, 0.6, -1}, Vector3{0.1 * out, 0.4, 1}}) {
      for (const double distance : {0.45, 0.7, 0.88}) {
        Handed one;
        one.play(0.3);
        const Vector3 place = one.place(side, way, distance);
        one.player.reach(side, {place, 1, false});
        one.play(1.5);
        EXPECT_LT((one.hand(side) - place).norm(), 0.001) << side << " " << way.transpose() << " " << distance;
      }
    }
  }
}

TEST(Reaching, LeansForWhatIsALittleFarther) {
  Handed one;
  one.play(0.3);
  const double length = one.length(1);
  const Vector3 place = one.place(1, {0.3, 1, 0}, 1.02), before = one.shoulder(1);
  one.player.reach(1, {place, 1, false});
  one.play(1.5);
  EXPECT_LT((one.hand(1) - place).norm(), 0.001);
  EXPECT_GT((one.shoulder(1) - before).norm(), 0.05 * length);
}

TEST(Reaching, GoesAlongWithWhatIsCarried) {
  Handed one;
  const Vector3 place{0.2, 0.35, 1.2};
  one.player.reach(1, {place, 1, true});
  one.play(1, kWalksBy);
  for (int i = 0; i < 120; ++i) {
    one.step({0, 1.2, 0.5, 0});
    EXPECT_LT((one.hand(1) - one.frame().to_world(place)).norm(), 0.001) << i;
  }
}

TEST(Reaching, StaysOnAPlaceThatItWalksBy) {
  Handed one;
  one.play(0.3);
  const Vector3 place = one.frame().to_world({0.4, 1.4, 1.2});
  one.player.reach(1, {place, 1, false});
  double nearest = 10, there = 0;
  for (int i = 0; i < 180; ++i) {
    one.step(kWalksBy);
    nearest = std::min(nearest, (one.shoulder(1) - place).norm() / one.length(1));
    if ((one.hand(1) - place).norm() < 0.001) there += kReachFrame;
  }
  EXPECT_LT(nearest, 0.9);
  EXPECT_GT(there, 0.3);
}

TEST(Reaching, LeavesWhatIsFarAwayOrBehind) {
  for (const Vector3& way : {Vector3{0, 1, 0}, Vector3{-0.2, -1, 0}}) {
    Handed one, other;
    one.play(0.3);
    other.play(0.3);
    const double distance = way.y() > 0 ? 4 : 0.8;
    one.player.reach(1, {one.place(1, way, distance), 1, false});
    for (int i = 0; i < 90; ++i) {
      one.step();
      other.step();
    }
    EXPECT_EQ(one.player.rotations(), other.player.rotations()) << way.transpose();
  }
}

// How fast the hand's speed changes from one frame to the next at most, m/s, seen from a character that walks.
double roughest(int told) {
  Handed one;
  one.play(0.5, kWalksBy);
  const Vector3 here{0.4, 0.45, 1.25}, there{0.35, 0.5, 1.0};
  Vector3 hand = one.hand(1), speed = Vector3::Zero();
  double most = 0;
  for (int i = 0; i < 300; ++i) {
    if (told == 1 && i == 30) one.player.reach(1, {here, 1, true});
    if (told == 1 && i == 120) one.player.reach(1, {there, 1, true});
    if (told == 1 && i == 200) one.player.reach(1, {there, 0, true});
    if (told == 2 && i % 6 == 0) one.player.reach(1, {here, std::clamp((i - 30) / 60.0, 0.0, 1.0), true});
    if (told == 3 && i == 30) one.player.reach(1, {one.frame().to_world(here + Vector3{0, 0.6, 0}), 1, false});
    if (told == 3 && i == 60) one.player.reach(1, {here, 1, true});
    one.step(kWalksBy);
    const Vector3 seen = one.frame().to_local(one.hand(1)), now = (seen - hand) / kReachFrame;
    if (i > 1) most = std::max(most, (now - speed).norm());
    hand = seen;
    speed = now;
  }
  return most;
}

TEST(Reaching, IsSmoothHoweverItIsTold) {
  const double captured = roughest(0);
  for (const int told : {1, 2, 3}) EXPECT_LT(roughest(told), captured + 0.3) << told;  // one that is there at once: 40
}

TEST(Reaching, WhipsNoArmForWhatGoesRoundIt) {
  for (const double height : {0.9, 1.2, 1.4, 1.6, 2.0}) {
    for (const double radius : {0.2, 0.35, 0.7}) {
      Handed one;
      one.play(0.5, kWalksBy);
      PosedBones before = one.posed;
      double furthest = 0;
      for (int i = 0; i < 400; ++i, before = one.posed) {
        const double angle = 0.1 * i;
        one.player.reach(1, {{radius * std::sin(angle), radius * std::cos(angle), height}, 1, true});
        one.step(kWalksBy);
        for (const int bone : {one.ranges[1].arm.upper, one.ranges[1].arm.hand})
          furthest = std::max(furthest, one.posed.rotations[bone].angularDistance(before.rotations[bone]));
      }
      EXPECT_LT(furthest, 0.6) << height << " " << radius;  // rad in a frame; one that is there at once: 3
    }
  }
}

TEST(Reaching, FollowsAWeightThatIsKeyed) {
  Handed one, other;
  const Vector3 place{0.25, 0.4, 1.25};
  for (int i = 0; i < 120; ++i) {
    const double weight = std::clamp(i / 90.0, 0.0, 1.0);
    if (i % 6 == 0) one.player.reach(1, {place, std::clamp((i + 6) / 90.0, 0.0, 1.0), true});
    one.step(kWalksBy);
    other.step(kWalksBy);
    if (i < 12) continue;
    const Vector3 captured = other.hand(1), wanted = captured + weight * (one.frame().to_world(place) - captured);
    EXPECT_LT((one.hand(1) - wanted).norm(), 0.02) << i;
  }
}

TEST(Reaching, StraightensNoElbowWithASnap) {
  Handed one;
  const Arm& arm = one.ranges[1].arm;
  std::vector<double> straight(std::size_t{4} * one.kinematics.bones());
  for (int b = 0; b < one.kinematics.bones(); ++b) straight[std::size_t{4} * b] = 1;
  const auto bend_at = [&](double distance) {
    one.kinematics.world(Vector3::Zero(), straight.data(), one.posed.heads.data(), one.posed.rotations.data());
    const Vector3 way = (one.hand(1) - one.shoulder(1)).normalized(), halfway{0, 1, -1};
    std::vector<double> bent = straight;
    reach(one.skeleton(), arm, one.posed, one.shoulder(1) + way * distance * one.length(1), 1, halfway, bent.data());
    one.kinematics.world(Vector3::Zero(), bent.data(), one.posed.heads.data(), one.posed.rotations.data());
    return one.bend(1);
  };
  for (double distance = 0.8; distance < 1.2; distance += 0.001) {
    EXPECT_LT(std::abs(bend_at(distance) - bend_at(distance + 0.001)), 0.01)
        << distance;  // one that gets straight: 0.1
  }
}

TEST(Reaching, BendsElbowsAsElbowsBend) {
  for (const double distance : {0.2, 0.5, 0.8}) {
    Handed one;
    one.play(0.3);
    one.player.reach(1, {one.place(1, {0.1, 1, 0}, distance), 1, false});
    one.play(1.5);
    const Arm& arm = one.ranges[1].arm;
    const Vector3 elbow = one.frame().to_local(one.posed.heads[arm.elbow]), hand = one.frame().to_local(one.hand(1)),
                  shoulder = one.frame().to_local(one.shoulder(1));
    EXPECT_LT(elbow.z(), (hand.z() + shoulder.z()) / 2 - 0.02) << distance;  // it hangs
    EXPECT_LE(one.bend(1), 2.51) << distance;
  }
}

TEST(Reaching, IsToTheBitAsCapturedBeforeAndAfter) {
  Handed one, other;
  for (int i = 0; i < 300; ++i) {
    if (i == 60) one.player.reach(0, {{-0.3, 0.4, 1.2}, 0.7, true});
    if (i == 200) one.player.reach(0, {{-0.3, 0.4, 1.2}, 0, true});
    one.step(kWalksBy);
    other.step(kWalksBy);
    EXPECT_EQ(one.player.root_position(), other.player.root_position());
    if (i < 60 || i > 240) {
      EXPECT_EQ(one.player.rotations(), other.player.rotations()) << i;
    }
    if (i > 65 && i < 200) {
      EXPECT_NE(one.player.rotations(), other.player.rotations()) << i;
    }
  }
}

TEST(Reaching, AllocatesNothing) {
  Player player(looking_character());
  const std::size_t before = allocations;
  for (int i = 0; i < 300; ++i) {
    player.reach(i % 2, {{std::sin(0.1 * i), 2, 1}, i % 7 / 6.0, i % 3 == 0});
    player.step(kWalksBy, kReachFrame);
  }
  EXPECT_EQ(allocations - before, 0U);
}

TEST(Reaching, RefusesWhatIsNoHandWeightOrPlace) {
  Player player(looking_character());
  EXPECT_THROW(player.reach(2, {}), std::invalid_argument);
  EXPECT_THROW(player.reach(0, {{0, 0, 0}, 1.5, false}), std::invalid_argument);
  EXPECT_THROW(player.reach(0, {{0, std::nan(""), 0}, 1, false}), std::invalid_argument);
  EXPECT_THROW(player.reach(0, {{0, 0, 1e11}, 1, false}), std::invalid_argument);
}

}  // namespace
}  // namespace fragmotion

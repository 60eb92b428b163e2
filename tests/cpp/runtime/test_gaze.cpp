// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "allocations.hpp"
#include "looking.hpp"
#include "runtime/look_stitch.hpp"
#include "runtime/player.hpp"

namespace fragmotion {
namespace {

constexpr double kLookFrame = 1.0 / 60;
constexpr Control kStands{0, 0, 0, 0}, kWalks{0, 1.2, 0, 0}, kTurnsLeft{0, 1.2, 1, 0};

// What is seen of a player from outside: the oracle.
struct Watched {
  Player player{looking_character()};
  GazeRange range = looks_in({&looking_character()->pool}).gaze;
  Kinematics kinematics{looking_character()->pool.skeleton};
  PosedBones posed{kinematics.bones()};
  int head = kinematics.skeleton().roles.head;

  void step(const Control& control = kStands, double seconds = kLookFrame) {
    player.step(control, seconds);
    kinematics.world(player.root_position(), player.rotations().data(), posed.heads.data(), posed.rotations.data());
  }
  void play(double seconds, const Control& control = kStands) {
    for (double time = 0; time < seconds; time += kLookFrame) step(control);
  }
  Vector3 eyes() const { return posed.heads[head] + posed.rotations[head] * (kinematics.skeleton().tips[head] / 2); }
  Vector3 looks() const { return posed.rotations[head] * range.forward; }
  // To the left of where it faces, as it would be seen or looks.
  double side(const Vector3& direction) const {
    return std::remainder(std::atan2(-direction.x(), direction.y()) - player.frame().heading, 2 * kPi);
  }
  double off(const Vector3& place) const {
    return std::acos(std::clamp(looks().dot((place - eyes()).normalized()), -1.0, 1.0));
  }
  Vector3 place(double side, double distance, double height) const {
    const CharacterFrame frame = player.frame();
    return frame.to_world({-distance * std::sin(side), distance * std::cos(side), height});
  }
};

TEST(GazeRange, IsAsFarAsHeadAndChestTurnInTheTakes) {
  const GazeRange range = looks_in({&looking_character()->pool}).gaze;
  EXPECT_NEAR(range.turn, kLooksAside, 0.08);
  EXPECT_LT(range.turn, kLooksAside + 0.05);
  EXPECT_NEAR(range.chest, kChestAside, 0.08);
  EXPECT_NEAR(range.up - range.down, 2 * kNods, 0.06);  // straight ahead is their mean
}

TEST(GazeRange, IsWhatAHeadDoesWithoutEffortWhereNobodyLooksAbout) {
  const GazeRange range = looks_in({&gait_character()->pool}).gaze;
  EXPECT_NEAR(range.turn, 0.61, 0.01);
  EXPECT_NEAR(range.down, -0.48, 0.01);
  EXPECT_NEAR(range.up, 0.65, 0.01);
  EXPECT_LT(range.chest, 0.2);
}

TEST(GazeRange, IsNoneOfABodyWithoutAHead) {
  const Character tiny = tiny_character();
  EXPECT_EQ(looks_in({&tiny.pool}).gaze.turn, 0);
  Player one(std::make_shared<const Character>(tiny)), other(std::make_shared<const Character>(tiny));
  one.look(Look::at, {3, 3, 1});
  for (int i = 0; i < 60; ++i) {
    one.step(kWalks, kLookFrame);
    other.step(kWalks, kLookFrame);
    ASSERT_EQ(one.rotations(), other.rotations());
  }
}

TEST(Gaze, IsOnThePlaceFromWhereverItIsWithinItsRange) {
  for (const double side : {-0.8, -0.3, 0.0, 0.5, 0.85}) {
    Watched one;
    one.play(0.5);
    const Vector3 place = one.place(side, 4, 1.2);
    one.player.look(Look::at, place);
    one.play(2);
    EXPECT_LT(one.off(place), 0.01) << side;
    double most = 0;
    for (int i = 0; i < 120; ++i) {
      one.step(kWalks);
      if (std::abs(one.side(place - one.eyes())) < 0.9 * one.range.turn) most = std::max(most, one.off(place));
    }
    EXPECT_LT(most, 0.01) << side;
  }
}

TEST(Gaze, GoesNoFartherThanInTheTakes) {
  for (const double side : {-2.0, 1.6, 3.0}) {
    Watched one;
    one.play(0.5);
    one.player.look(Look::at, one.place(side, 3, 9));
    one.play(2);
    for (int i = 0; i < 100; ++i) {
      one.step();
      EXPECT_NEAR(std::abs(one.side(one.looks())), one.range.turn, 0.02) << side;
      EXPECT_NEAR(std::asin(one.looks().z()), one.range.up, 0.02) << side;
    }
    EXPECT_GT(one.side(one.looks()) * side, 0);
  }
}

// A chest that turns with the head as it does in the takes.
TEST(Gaze, TurnsTheChestByItsShare) {
  Watched one, other;
  const int chest = Trunk(one.kinematics.skeleton()).chest;
  one.player.look(Look::at, one.place(0.9, 50, 1.6));
  one.play(3);
  other.play(3);
  const Quaternion turned = one.posed.rotations[chest] * other.posed.rotations[chest].conjugate();
  const double by_head = one.side(one.looks()) - other.side(other.looks());
  EXPECT_NEAR(2 * std::asin(turned.z()), by_head * one.range.chest / one.range.turn, 0.01);
  EXPECT_NEAR(std::hypot(turned.x(), turned.y()), 0, 1e-9);
}

TEST(Gaze, TurnsTheHeadNoFasterThanHeadsDo) {
  Watched one;
  const double fastest = looks_in({&looking_character()->pool}).fastest.back();
  Random random(3);
  double most = 0, gaze = 0;
  for (int i = 0; i < 3000; ++i) {
    if (i % 47 == 0) {
      one.player.look(random.below(4) == 0 ? Look::as_captured : Look::at,
                      one.place(6 * random.uniform() - 3, 1 + 3 * random.uniform(), 2 * random.uniform()));
    }
    const Quaternion before = one.posed.rotations[one.head];
    const Vector3 looked = one.looks();
    one.step(kWalks);
    if (i == 0) continue;
    most = std::max(most, before.angularDistance(one.posed.rotations[one.head]) / kLookFrame);
    gaze = std::max(gaze, Quaternion::FromTwoVectors(looked, one.looks()).angularDistance(Quaternion::Identity()));
  }
  EXPECT_LT(gaze / kLookFrame, 1.001 * kTurnsAtMost * fastest);
  EXPECT_GT(gaze / kLookFrame, 0.5 * fastest);
  EXPECT_LT(most, 1.001 * kTurnsAtMost * fastest);
}

TEST(Gaze, BeginsAndEndsGently) {
  Watched one;
  one.play(1);
  one.player.look(Look::at, one.place(0.9, 3, 1.5));
  double speed = 0, most = 0;
  for (int i = 0; i < 240; ++i) {
    if (i == 120) one.player.look(Look::as_captured);
    const Quaternion before = one.posed.rotations[one.head];
    one.step();
    const double now = before.angularDistance(one.posed.rotations[one.head]) / kLookFrame;
    if (i > 0) most = std::max(most, std::abs(now - speed));
    speed = now;
  }
  EXPECT_LT(most, 1.2);  // rad/s a frame: a head that was there at once would jump by 50
}

TEST(Gaze, IsToTheBitAsCapturedBeforeAndAfter) {
  Watched one, other;
  const auto same = [&] { return one.player.rotations() == other.player.rotations(); };
  for (int i = 0; i < 400; ++i) {
    if (i == 100) one.player.look(Look::at, one.place(0.8, 3, 1));
    if (i == 200) one.player.look(Look::as_captured);
    one.step(kWalks);
    other.step(kWalks);
    EXPECT_EQ(one.player.root_position(), other.player.root_position());
    if (i < 100) {
      EXPECT_TRUE(same()) << i;
    } else if (i > 110 && i < 200) {
      EXPECT_FALSE(same()) << i;
    }
  }
  EXPECT_TRUE(same());
  one.player.look(Look::at, {1, 1, 1});
  one.step(kWalks);
  for (Watched* each : {&one, &other}) each->player.reset();
  for (int i = 0; i < 60; ++i) {
    one.step(kWalks);
    other.step(kWalks);
    ASSERT_TRUE(same());
  }
}

TEST(Gaze, IsWhereItGoes) {
  Watched one;
  one.player.look(Look::ahead);
  one.play(2, kWalks);
  EXPECT_NEAR(one.side(one.looks()), 0, 0.02);
  one.play(2, kTurnsLeft);
  const double rate = looking_character()->space.turn_rate();
  EXPECT_NEAR(one.side(one.looks()), std::min(rate / 2, one.range.turn), 0.05);
  one.play(2, {-1, 1, 0, 0});
  EXPECT_NEAR(one.side(one.looks()), kPi / 4, 0.05);
}

TEST(Gaze, LooksOnOverTheShoulderThatItLooksOver) {
  Watched one;
  for (const double side : {2.0, 3.0, -3.0, -2.5}) {
    one.player.look(Look::at, one.place(side, 3, 1.6));
    one.play(2);
    EXPECT_GT(one.side(one.looks()), 0.5) << side;
  }
  one.player.look(Look::at, one.place(-2.0, 3, 1.6));
  one.play(2);
  EXPECT_LT(one.side(one.looks()), -0.5) << "it is much nearer on the other side";
}

TEST(Gaze, AllocatesNothing) {
  Player player(looking_character());
  const std::size_t before = allocations;
  for (int i = 0; i < 300; ++i) {
    player.look(static_cast<Look>(i / 40 % 3), {std::sin(0.1 * i), 2, 1});
    player.step(kWalks, kLookFrame);
  }
  EXPECT_EQ(allocations - before, 0U);
}

TEST(Gaze, RefusesWhatIsNoPlace) {
  Player player(looking_character());
  EXPECT_THROW(player.look(Look::at, {0, std::nan(""), 0}), std::invalid_argument);
  EXPECT_THROW(player.look(Look::at, {0, 1e11, 0}), std::invalid_argument);
}

}  // namespace
}  // namespace fragmotion

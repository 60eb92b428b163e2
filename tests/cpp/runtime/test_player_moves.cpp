// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "allocations.hpp"
#include "character/policy_file.hpp"
#include "control/simulated_players.hpp"
#include "evaluate/performance.hpp"
#include "fragments/entry_poses.hpp"
#include "made_moves.hpp"
#include "mocap_files.hpp"
#include "runtime/crowd.hpp"
#include "steering.hpp"

namespace fragmotion {
namespace {

constexpr int kLunge = 0, kLongLunge = 1, kWave = 2, kLongWave = 3;

PlayerOptions bare() {
  PlayerOptions options;
  options.lock_feet = false;
  return options;
}

// Steps until `done`, for so many seconds at most; tells how many went by.
template <typename Done>
double steps_until(Player& player, const Control& control, double most, const Done& done) {
  double seconds = 0;
  for (; seconds < most && !done(); seconds += kStep) player.step(control, kStep);
  return seconds;
}

bool lunges(const Player& player) { return player.playing_moves()[0] >= 0; }
bool waves(const Player& player) { return player.playing_moves()[1] >= 0; }

TEST(PlayerMoves, AreThePoliciesBitsWhereNoneIsPressed) {
  const Trace trace = simulate_trace("explorer", 20, 3, gait_character()->space);
  const Performance with = perform(Player(moving_character(), {4}), trace, 60),
                    without = perform(Player(gait_character(), {4}), trace, 60);
  EXPECT_EQ(with.root_positions, without.root_positions);
  EXPECT_EQ(with.rotations, without.rotations);
  EXPECT_EQ(with.classes, without.classes);
}

TEST(PlayerMoves, BeginWithinTheirTimeToWaitAndLastTheirLength) {
  for (const Control& control : {kStand, kForward, Control{0, 3, 0, 0}, Control{1.2, 0, 1, 0}}) {
    for (double before = 1; before < 2; before += 0.13) {
      Player player(moving_character());
      settle(player, control, before);
      player.start_move(kLunge);
      EXPECT_EQ(player.waiting_moves()[0], kLunge);
      const double waited = steps_until(player, control, 2, [&] { return lunges(player); });
      EXPECT_LE(waited, 0.5 + 2 * kStep);
      EXPECT_EQ(player.waiting_moves()[0], -1);
      const double played = steps_until(player, control, 3, [&] { return !lunges(player); });
      EXPECT_NEAR(played, 1.5, 2 * kStep);
      settle(player, control, 1);
      EXPECT_FALSE(lunges(player));
    }
  }
}

TEST(PlayerMoves, BeginAtOnceWithoutTimeToWait) {
  Player player(
      std::make_shared<const Character>(with_moves(*gait_character(), {{"lunge", lunge_clip(), false, 0, {}}})));
  settle(player, kForward, 1.23);
  player.start_move(0);
  player.step(kForward, kStep);
  EXPECT_TRUE(lunges(player));
}

// The distance of a lunge's first pose from what is shown, of places.
double join(const Player& player, const Character& c, int move) {
  const Clip clip = unpack(c.pool.clips[c.moves[move].clip]);
  const Kinematics kinematics(c.pool.skeleton);
  PosedBones shown(kinematics.bones()), first(kinematics.bones());
  kinematics.world(player.root_position(), player.rotations().data(), shown.heads.data(), shown.rotations.data());
  world(kinematics, clip, 0, first.heads.data(), first.rotations.data());
  const CharacterFrame is = player.frame(), was = {load_vector(clip.root_positions.data()).head<2>(), clip.headings[0]};
  double sum = 0;
  for (int b = 0; b < kinematics.bones(); ++b) {
    sum += (is.to_local(shown.heads[b]) - was.to_local(first.heads[b])).norm();
  }
  return sum;
}

// Over many presses, where a move begins its first pose is nearer to what is shown than where it was pressed.
TEST(PlayerMoves, BeginWhereTheyJoinBetterThanWhereTheyWerePressed) {
  double pressed = 0, begun = 0;
  for (double before = 1; before < 3; before += 0.11) {
    Player player(moving_character(), bare());
    settle(player, kForward, before);
    pressed += join(player, *moving_character(), kLunge);
    player.start_move(kLunge);
    double last = 0;
    steps_until(player, kForward, 2, [&] {
      if (lunges(player)) return true;
      last = join(player, *moving_character(), kLunge);
      return false;
    });
    begun += last;
  }
  EXPECT_LT(begun, 0.95 * pressed);
}

// How far the arms are turned from those of a move's first pose, rad.
double arms_apart(const Player& player, const Character& c, int move) {
  const Clip clip = unpack(c.pool.clips[c.moves[move].clip]);
  double sum = 0;
  for (const char* bone : {"upper_arm.L", "upper_arm.R"}) {
    const std::size_t at = std::size_t{4} * c.pool.skeleton.find(bone);
    sum += load_quaternion(&player.rotations()[at]).angularDistance(load_quaternion(&clip.rotations[at]));
  }
  return sum;
}

// Where a move of the upper body begins, the arms of one that walks are off from its first pose by no more than they
// swing within half of the time between two moments that are looked at.
TEST(PlayerMoves, OfTheUpperBodyBeginWhereSwingingArmsJoinBest) {
  const Character& c = *moving_character();
  for (double before = 1; before < 3; before += 0.11) {
    Player player(moving_character(), bare());
    settle(player, kForward, before - 0.5);
    double apart = 0, swing = 0;
    const auto look = [&] {
      if (waves(player)) return true;
      const double now = arms_apart(player, c, kWave), was = std::exchange(apart, now);
      swing = std::max(swing, std::abs(now - was) / kStep);
      return false;
    };
    apart = arms_apart(player, c, kWave);
    steps_until(player, kForward, 0.5, look);
    player.start_move(kWave);
    steps_until(player, kForward, 0.5, look);
    EXPECT_LE(apart, swing * kMomentsApart / 2) << before;
  }
}

TEST(PlayerMoves, KeepTheirRootMotion) {
  Player player(moving_character(), bare());
  settle(player, kStand);
  player.start_move(kLunge);
  steps_until(player, kStand, 1, [&] { return lunges(player); });
  const CharacterFrame before = player.frame();
  steps_until(player, kStand, 2, [&] { return !lunges(player); });
  const CharacterFrame after = player.frame();
  EXPECT_NEAR(after.heading - before.heading, 0.8, 0.08);  // headings are smoothed (facing.hpp)
  const Vector3 way = before.to_local({after.position.x(), after.position.y(), 0});
  EXPECT_NEAR(way.y(), 0.6, 0.03);
  EXPECT_NEAR(way.x(), 0, 0.03);
}

TEST(PlayerMoves, GoIntoWhatTheControlSaysAtTheirEnd) {
  for (const bool goes : {false, true}) {
    const Control control = goes ? kForward : kStand;
    Player player(moving_character());
    settle(player, kStand);
    player.start_move(kLunge);
    steps_until(player, kStand, 1, [&] { return lunges(player); });
    steps_until(player, control, 2, [&] { return !lunges(player); });
    const Vector2 from = player.frame().position;
    settle(player, control, 2);
    EXPECT_NEAR((player.frame().position - from).norm(), goes ? 2.2 : 0, 0.4);
  }
}

TEST(PlayerMoves, LoopWhileTheyAreHeldAndPlayToTheirEnd) {
  for (const int move : {kLongLunge, kLongWave}) {
    const int track = move == kLongWave ? 1 : 0;
    const auto plays = [&](const Player& player) { return player.playing_moves()[track] == move; };
    for (const double held : {0.0, 3.3}) {
      Player player(moving_character());
      settle(player, kStand);
      player.start_move(move);
      steps_until(player, kStand, 1, [&] { return plays(player); });
      settle(player, kStand, held);
      EXPECT_TRUE(plays(player));
      player.release_move(move);
      const double length = track == 1 ? 2 : 1.5, loop = track == 1 ? 0.8 : 0.5;
      const double rest = steps_until(player, kStand, 5, [&] { return !plays(player); });
      const double times = (held + rest - length) / loop;
      EXPECT_NEAR(times, std::round(times), 0.1);
      EXPECT_EQ(std::round(times), held == 0 ? 0 : std::ceil((held - length + (track == 1 ? 0.6 : 0.5)) / loop));
    }
  }
}

TEST(PlayerMoves, FollowOneAnother) {
  Player player(moving_character());
  settle(player, kStand);
  player.start_move(kLunge);
  steps_until(player, kStand, 1, [&] { return lunges(player); });
  player.start_move(kLongLunge);
  steps_until(player, kStand, 3, [&] { return player.playing_moves()[0] != kLunge; });
  EXPECT_EQ(player.playing_moves()[0], kLongLunge);
}

TEST(PlayerMoves, WaitForALanding) {
  Player player(moving_character());
  settle(player, kStand);
  const double jumped = steps_until(player, {0, 0, 0, 1}, 2, [&] {
    return player.character().pool.fragments[player.playing_fragment()].evident.jumps();
  });
  ASSERT_LT(jumped, 2);
  player.start_move(kLunge);
  double lowest = 10;
  const double waited = steps_until(player, kStand, 3, [&] {
    lowest = std::min(lowest, player.root_position().z());
    return lunges(player);
  });
  EXPECT_LT(waited, 3);
  EXPECT_LT(player.root_position().z(), 0.94 + 0.1) << "it is in the air";
  EXPECT_GT(player.root_position().z(), lowest) << "it is still on its way down";
}

// Legs and root are those of a player that does not wave, to the bit; the arm goes up.
TEST(PlayerMoves, OfTheUpperBodyLeaveTheLegsAlone) {
  Player still(moving_character()), waving(moving_character());
  const Skeleton& skeleton = still.character().pool.skeleton;
  const int arm = skeleton.find("upper_arm.R");
  double most = 0;
  for (int i = 0; i < 480; ++i) {
    if (i == 120) waving.start_move(kWave);
    const Control control = i < 300 ? kForward : Control{0, 3, 1, 0};
    still.step(control, kStep);
    waving.step(control, kStep);
    ASSERT_EQ(still.root_position(), waving.root_position());
    for (int b = 0; b < skeleton.size(); ++b) {
      const double *a = &still.rotations()[std::size_t{4} * b], *c = &waving.rotations()[std::size_t{4} * b];
      if (b == 0 || skeleton.names[b].find("thigh") == 0 || skeleton.names[b].find("shin") == 0 ||
          skeleton.names[b].find("foot") == 0) {
        ASSERT_TRUE(std::equal(a, a + 4, c)) << skeleton.names[b] << " " << i;
      } else if (i < 120 || i > 120 + 60 * 3.1) {
        ASSERT_TRUE(std::equal(a, a + 4, c)) << skeleton.names[b] << " " << i;
      } else if (b == arm) {
        most = std::max(most, load_quaternion(a).angularDistance(load_quaternion(c)));
      }
    }
  }
  EXPECT_GT(most, 2);
}

// The trunk points as in the move, seen from where the character faces.
TEST(PlayerMoves, OfTheUpperBodyKeepWhereTheyPoint) {
  Player player(moving_character(), bare());
  settle(player, {0, 1.2, 1, 0}, 2.4);
  player.start_move(kWave);
  steps_until(player, {0, 1.2, 1, 0}, 1, [&] { return waves(player); });
  settle(player, {0, 1.2, 1, 0}, 1);
  const Quaternion hips = load_quaternion(player.rotations().data()),
                   spine = hips * load_quaternion(&player.rotations()[4]);
  const Quaternion facing = CharacterFrame{{0, 0}, player.frame().heading + kPi}.rotation();
  EXPECT_LT(spine.angularDistance(facing), 0.1);
}

// No joint goes further in a frame than the fastest of takes and moves, and what a stitch allows.
TEST(PlayerMoves, NeverJump) {
  const auto c = moving_character();
  const Kinematics kinematics(c->pool.skeleton);
  for (const Stitching stitching : {Stitching::inertialize, Stitching::crossfade}) {
    PlayerOptions options;
    options.stitching = stitching;
    Player player(c, options);
    Random random(9);
    PosedBones before(kinematics.bones()), now(kinematics.bones());
    Control control;
    for (int i = 0; i < 60 * 40; ++i) {
      if (i % 37 == 0) control = c->space.point(random.below(kPaperPoints));
      if (i % 53 == 0) player.start_move(random.below(4));
      if (i % 71 == 0) player.release_move(random.below(4));
      player.step(control, kStep);
      kinematics.world(player.root_position(), player.rotations().data(), now.heads.data(), now.rotations.data());
      for (int b = 0; i > 0 && b < kinematics.bones(); ++b) {
        EXPECT_LT((now.heads[b] - before.heads[b]).norm(), 25 * kStep) << i << " " << c->pool.skeleton.names[b];
      }
      std::swap(before, now);
    }
  }
}

TEST(PlayerMoves, PlayTheSameAfterAResetAndFromAFile) {
  const auto shown = [](Player& player) {
    const Trace trace = simulate_trace("walker", 12, 3, player.character().space);
    return perform(player, trace, 60, {}, {{10, kLunge, 2}, {40, kWave, 0}, {60, kLongLunge, 30}, {119, kWave, 1}});
  };
  Player player(moving_character(), {7});
  const Performance first = shown(player);
  player.start_move(kLongWave);
  player.reset();
  const Performance again = shown(player);
  EXPECT_EQ(first.rotations, again.rotations);
  EXPECT_EQ(first.root_positions, again.root_positions);
  EXPECT_EQ(first.moves, again.moves);
  const auto loaded = std::make_shared<const Character>(from_bytes(to_bytes(*moving_character())));
  Player other(loaded, {7});
  EXPECT_EQ(shown(other).rotations, first.rotations);
  for (const int move : {kLunge, kLongLunge, kWave}) {
    EXPECT_NE(std::find(first.moves.begin(), first.moves.end(), move), first.moves.end()) << move;
  }
}

TEST(PlayerMoves, OfACrowdAreThoseOfPlayersAlone) {
  Crowd crowd(moving_character(), 5, {3}, 2);
  std::vector<double> roots(15);
  std::vector<double> rotations(std::size_t{4} * 5 * crowd.bones());
  const std::vector<Control> controls(5, kForward);
  for (int i = 0; i < 200; ++i) {
    if (i == 60) crowd.start_move(2, kLunge);
    if (i == 70) crowd.start_move(3, kLongWave);
    if (i == 90) crowd.release_move(3, kLongWave);
    crowd.step(controls.data(), kStep, roots.data(), rotations.data());
  }
  for (int p = 0; p < 5; ++p) {
    PlayerOptions options;
    options.seed = 3 + p;
    Player alone(moving_character(), options);
    for (int i = 0; i < 200; ++i) {
      if (i == 60 && p == 2) alone.start_move(kLunge);
      if (i == 70 && p == 3) alone.start_move(kLongWave);
      if (i == 90 && p == 3) alone.release_move(kLongWave);
      alone.step(kForward, kStep);
    }
    EXPECT_TRUE(std::equal(alone.rotations().begin(), alone.rotations().end(),
                           rotations.begin() + std::ptrdiff_t{4} * crowd.bones() * p));
  }
}

TEST(PlayerMoves, AllocateNothing) {
  Player player(moving_character());
  Random random(1);
  const std::size_t before = allocations;
  for (int i = 0; i < 1500; ++i) {
    if (i % 40 == 0) player.start_move(random.below(4));
    if (i % 90 == 0) player.release_move(random.below(4));
    player.step(player.character().space.point(random.below(kPaperPoints)), 0.04 * random.uniform());
  }
  EXPECT_EQ(allocations - before, 0U);
}

TEST(PlayerMoves, ThatDoNotExistAreRefused) {
  Player player(moving_character()), none(gait_character());
  EXPECT_EQ(error_of([&] { player.start_move(4); }), "move 4 does not exist; the character has 4");
  EXPECT_EQ(error_of([&] { none.start_move(0); }), "move 0 does not exist; the character has 0");
  EXPECT_EQ(error_of([&] { player.release_move(-1); }), "move -1 does not exist; the character has 4");
  const Trace trace(20);
  for (const MovePress& wrong : {MovePress{0, 4, 1}, {20, 0, 1}, {-1, 0, 1}, {0, 0, -1}}) {
    EXPECT_NE(error_of([&] { perform(player, trace, 60, {}, {wrong}); }), "no error");
  }
}

}  // namespace
}  // namespace fragmotion

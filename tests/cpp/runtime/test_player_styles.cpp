// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>

#include "allocations.hpp"
#include "control/simulated_players.hpp"
#include "evaluate/motion_metrics.hpp"
#include "evaluate/performance.hpp"
#include "fragments/look.hpp"
#include "made_styles.hpp"
#include "mocap_files.hpp"
#include "runtime/crowd.hpp"
#include "steering.hpp"

namespace fragmotion {
namespace {

constexpr int kNormal = 0, kTired = 1;

// Steps until a style plays, for 3 s at most; tells how many went by.
double change(Player& player, const Control& control, int style) {
  player.change_style(style);
  double seconds = 0;
  for (; seconds < 3 && player.playing_style() != style; seconds += kStep) player.step(control, kStep);
  return seconds;
}

void expect_same(const Performance& a, const Performance& b) {
  EXPECT_EQ(a.root_positions, b.root_positions);
  EXPECT_EQ(a.rotations, b.rotations);
  EXPECT_EQ(a.classes, b.classes);
  EXPECT_EQ(a.fragments, b.fragments);
}

TEST(PlayerStyles, AreThePoliciesBitsWhereNoneIsAskedFor) {
  const Trace trace = simulate_trace("explorer", 20, 3, gait_character()->space);
  expect_same(perform(Player(styled_character(), {4}), trace, 60), perform(Player(gait_character(), {4}), trace, 60));
}

// But for neck and head, which turn as fast as they do in any style.
Performance without_look(Performance performance, const Skeleton& skeleton) {
  for (int f = 0; f < performance.frames; ++f) {
    for (const int bone : look_bones(skeleton)) {
      const std::ptrdiff_t at = std::ptrdiff_t{4} * (std::ptrdiff_t{f} * skeleton.size() + bone);
      std::fill_n(performance.rotations.begin() + at, 4, 0.0);
    }
  }
  return performance;
}

TEST(PlayerStyles, PlayAsThatStyleAloneFromAReset) {
  const Trace trace = simulate_trace("explorer", 20, 3, tired_character()->space);
  PlayerOptions options{4};
  options.lock_feet = false;  // legs bend as in the first style
  Player styled(styled_character(), options);
  styled.reset({}, kTired);
  const Performance with = perform(styled, trace, 60), alone = perform(Player(tired_character(), options), trace, 60);
  const Skeleton& skeleton = tired_character()->pool.skeleton;
  expect_same(without_look(with, skeleton), without_look(alone, skeleton));
  EXPECT_EQ(with.quality, alone.quality);
  EXPECT_EQ(with.turn_error, alone.turn_error);
  EXPECT_EQ(with.drift, alone.drift);
  EXPECT_EQ(with.styles, std::vector<int>(with.frames, kTired));
}

TEST(PlayerStyles, BeginWithinTheirTimeToWait) {
  for (const Stitching stitching : {Stitching::inertialize, Stitching::crossfade}) {
    for (const Control& control : {kStand, kForward, Control{0, 3, 0, 0}, Control{1.2, 0, 1, 0}}) {
      for (double before = 1; before < 2; before += 0.13) {
        PlayerOptions options;
        options.stitching = stitching;
        Player player(styled_character(), options);
        settle(player, control, before);
        player.change_style(kTired);
        EXPECT_EQ(player.waiting_style(), kTired);
        EXPECT_LE(change(player, control, kTired), kStyleWait + 0.25);
        EXPECT_EQ(player.waiting_style(), -1);
        EXPECT_LE(change(player, control, kNormal), kStyleWait + 0.25);
      }
    }
  }
}

TEST(PlayerStyles, GoOnAtTheirOwnSpeedAndInTheirOwnClasses) {
  Player player(styled_character());
  settle(player, kForward);
  change(player, kForward, kTired);
  for (int f = 0; f < 120; ++f) {
    player.step(kForward, kStep);
    ASSERT_LT(player.playing_class(), tired_character()->classes.count);
    ASSERT_LT(player.playing_fragment(), tired_character()->pool.fragments.size());
  }
  EXPECT_EQ(&player.styled_character(), styled_character()->styles[0].get());
}

TEST(PlayerStyles, ChangeAsSmoothlyAsOtherStitches) {
  const Character& c = *styled_character();
  const auto worst = [&](const std::vector<StyleChange>& changes) {
    double worst = 0;
    for (int seed = 1; seed <= 4; ++seed) {
      Player player(styled_character(), {static_cast<std::uint64_t>(seed)});
      const Performance p = perform(player, Trace(100, kForward), 60, {}, {}, changes);
      worst = std::max(worst, MotionMetrics(c).of(p).positions.worst);
    }
    return worst;
  };
  EXPECT_LT(worst({{20, kTired}, {45, kNormal}, {70, kTired}}), 1.5 * worst({}));
}

TEST(PlayerStyles, OfAPressThatIsTakenBackAreForgotten) {
  Player player(styled_character()), other(styled_character());
  settle(player, kForward, 1.1);
  settle(other, kForward, 1.1);
  player.change_style(kTired);
  player.change_style(kNormal);
  EXPECT_EQ(player.waiting_style(), -1);
  settle(player, kForward);
  settle(other, kForward);
  EXPECT_EQ(player.rotations(), other.rotations());
}

TEST(PlayerStyles, BeginAfterTheLandingOfAJump) {
  for (double before = 0; before < 0.5; before += 0.05) {
    Player player(styled_character());
    settle(player, kStand);
    const auto jumps = [&] { return gait_character()->pool.fragments[player.playing_fragment()].evident.jumps(); };
    for (int f = 0; f < 120 && !jumps(); ++f) player.step({0, 0, 0, 1}, kStep);
    settle(player, kStand, before);
    ASSERT_TRUE(jumps());
    player.change_style(kTired);
    while (player.playing_style() == kNormal) {
      const auto feet = player.standing_feet();
      const bool stands = feet[0] || feet[1];
      player.step(kStand, kStep);
      EXPECT_TRUE(stands || player.playing_style() == kNormal) << before;
    }
    settle(player, kStand, 0.3);
    EXPECT_EQ(player.playing_style(), kTired);
  }
}

TEST(PlayerStyles, WaitForTheEndOfAMoveOfTheWholeBody) {
  Player player(styled_character());
  settle(player, kStand);
  player.start_move(0);
  while (player.playing_moves()[0] < 0) player.step(kStand, kStep);
  player.change_style(kTired);
  while (player.playing_moves()[0] >= 0) {
    EXPECT_EQ(player.playing_style(), kNormal);
    player.step(kStand, kStep);
  }
  EXPECT_EQ(player.playing_style(), kTired);
}

TEST(PlayerStyles, PlayMovesAndGoBackIntoTheirOwnClasses) {
  Player player(styled_character());
  player.reset({}, kTired);
  settle(player, kForward);
  player.start_move(0);
  player.start_move(2);
  settle(player, kForward, 4);
  EXPECT_EQ(player.playing_moves()[0], -1);
  EXPECT_EQ(player.playing_style(), kTired);
  EXPECT_LT(player.playing_class(), tired_character()->classes.count);
}

TEST(PlayerStyles, ForgetAClassThatWasForcedInAnother) {
  Player player(styled_character());
  settle(player, kForward);
  player.change_style(kTired);
  while (player.playing_style() != kTired) {
    player.force(gait_character()->classes.count - 1);
    player.step(kForward, kStep);
  }
  settle(player, kForward);
  EXPECT_NE(error_of([&] { player.force(tired_character()->classes.count); }), "no error");
}

TEST(PlayerStyles, AreTheSameBitsAfterAReset) {
  const Trace trace = simulate_trace("explorer", 10, 3, gait_character()->space);
  const std::vector<StyleChange> changes{{20, kTired}, {60, kNormal}, {80, kTired}};
  Player player(styled_character(), {4});
  const Performance once = perform(player, trace, 60, {}, {}, changes);
  EXPECT_EQ(player.playing_style(), kTired);
  player.reset();
  EXPECT_EQ(player.playing_style(), kNormal);
  const Performance again = perform(player, trace, 60, {}, {}, changes);
  expect_same(once, again);
  EXPECT_EQ(once.styles, again.styles);
  EXPECT_EQ(std::count(once.styles.begin(), once.styles.end(), kTired) > 120, true);
}

TEST(PlayerStyles, OfABranchAreItsOwn) {
  Player player(styled_character());
  settle(player, kForward);
  Player branch = player.branch();
  branch.change_style(kTired);
  EXPECT_EQ(player.waiting_style(), -1);
  settle(branch, kForward);
  EXPECT_EQ(branch.playing_style(), kTired);
  EXPECT_EQ(player.playing_style(), kNormal);
}

TEST(PlayerStyles, OfACrowdAreThoseOfPlayersAlone) {
  Crowd crowd(styled_character(), 6, {3}, 2);
  std::vector<Player> alone;
  for (std::uint64_t i = 0; i < 6; ++i) alone.emplace_back(styled_character(), PlayerOptions{3 + i});
  crowd.reset(5, {}, kTired);
  alone[5].reset({}, kTired);
  const std::vector<Control> controls(6, kForward);
  std::vector<double> roots(18);
  for (int f = 0; f < 240; ++f) {
    if (f == 60) crowd.change_style(2, kTired), alone[2].change_style(kTired);
    crowd.step(controls.data(), kStep, roots.data());
    for (int i = 0; i < 6; ++i) {
      alone[i].step(kForward, kStep);
      ASSERT_EQ(load_vector(&roots[3 * i]), alone[i].root_position()) << i << " at " << f;
    }
  }
  EXPECT_EQ(crowd[2].playing_style(), kTired);
}

TEST(PlayerStyles, AllocateNothingInSteps) {
  Player player(styled_character());
  settle(player, kForward);
  const std::size_t before = allocations;
  for (int i = 0; i < 8; ++i) {
    change(player, kForward, i % 2 == 0 ? kTired : kNormal);
    settle(player, kForward, 0.3);
  }
  EXPECT_EQ(allocations, before);
}

TEST(PlayerStyles, ThatDoNotExistAreRefused) {
  Player player(styled_character());
  for (const int style : {-1, 2}) {
    const std::string error = "style " + std::to_string(style) + " does not exist; the character has 2";
    EXPECT_EQ(error_of([&] { player.change_style(style); }), error);
    EXPECT_EQ(error_of([&] { player.reset({}, style); }), error);
    EXPECT_EQ(error_of([&] { perform(player, Trace(3), 30, {}, {}, {{0, style}}); }), error);
  }
  EXPECT_EQ(error_of([&] {
              perform(player, Trace(3), 30, {}, {}, {{3, kTired}});
            }),
            "a style is asked for before control 3 of a trace of 3");
}

}  // namespace
}  // namespace fragmotion

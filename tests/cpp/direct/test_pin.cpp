// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "control/simulated_players.hpp"
#include "direct/pin.hpp"
#include "small_character.hpp"

namespace fragmotion {
namespace {

CharacterFrame play(const Trace& trace, std::uint64_t seed, int frames) {
  PlayerOptions options;
  options.seed = seed;
  Player player(gait_character(), options);
  player.reset();
  for (int f = 0; f < frames; ++f) player.step(trace[f / 6], 1 / kGameRate);
  return player.frame();
}

TEST(Pin, IsReachedByTheTraceThatIsFound) {
  const Trace trace = simulate_trace("walker", 8, 3, gait_character()->space);
  CharacterFrame there = play(trace, 2, 360);
  there.position += Vector2{0.15, -0.1};
  there.heading += 0.1;
  PlayerOptions player;
  player.seed = 2;
  PinOptions options;
  for (const double begin : {0.0, 2.0}) {
    options.begin = begin;
    const Pin pin = find_pin(gait_character(), player, {}, trace, {6, there}, options);
    EXPECT_TRUE(pin.fits);
    const CharacterFrame reached = play(pin.trace, pin.seed, 360);
    EXPECT_EQ(reached.position, pin.reached.position);
    EXPECT_EQ(reached.heading, pin.reached.heading);
    EXPECT_LE((reached.position - there.position).norm(), options.distance);
  }
}

TEST(Pin, IsTheSameWithAnyNumberOfThreads) {
  const Trace trace = simulate_trace("explorer", 5, 1, gait_character()->space);
  PinOptions options;
  options.begin = 1;
  options.tries = 300;
  const auto found = [&](int threads) {
    options.threads = threads;
    return find_pin(gait_character(), {}, {}, trace, {4, {{1, 1}, 1}}, options);
  };
  const Pin one = found(1), three = found(3);
  EXPECT_EQ(one.reached.position, three.reached.position);
  EXPECT_EQ(one.tries, three.tries);
  for (std::size_t i = 0; i < trace.size(); ++i) EXPECT_EQ(one.trace[i].y, three.trace[i].y);
}

TEST(Player, BranchesIntoOneThatGoesOnAsItWould) {
  const Trace trace = simulate_trace("runner", 6, 4, gait_character()->space);
  Player whole(gait_character()), begun(gait_character());
  for (int f = 0; f < 200; ++f) {
    whole.step(trace[f / 6], 1 / kGameRate);
    begun.step(trace[f / 6], 1 / kGameRate);
  }
  Player other = begun.branch(), branch = begun.branch();
  for (int f = 0; f < 100; ++f) other.step({0, -1, 1, 0}, 1 / kGameRate);
  for (int f = 200; f < 360; ++f) {
    whole.step(trace[f / 6], 1 / kGameRate);
    branch.step(trace[f / 6], 1 / kGameRate);
    ASSERT_EQ(whole.root_position(), branch.root_position());
    ASSERT_EQ(whole.rotations(), branch.rotations());
  }
}

TEST(Player, DrawsFromAnotherSeedAfterTheNextReset) {
  PlayerOptions options;
  options.seed = 9;
  Player made(gait_character(), options), reseeded(gait_character());
  reseeded.reseed(9);
  reseeded.reset();
  for (int f = 0; f < 300; ++f) {
    made.step({0, 1.2, 0, 0}, 1 / kGameRate);
    reseeded.step({0, 1.2, 0, 0}, 1 / kGameRate);
    ASSERT_EQ(made.playing_fragment(), reseeded.playing_fragment());
  }
}

}  // namespace
}  // namespace fragmotion

// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>

#include "fragments/successors.hpp"
#include "policy/answer.hpp"
#include "runtime/held_gaits.hpp"
#include "runtime/player.hpp"
#include "small_character.hpp"

namespace fragmotion {
namespace {

struct Gaits {
  explicit Gaits(const Character& of) : character(of) {}
  const Character& character;
  TransitionCost cost{character, {}};
  std::vector<int> next = successors(character.pool.fragments);
  std::vector<EntrySteps> steps = entry_steps(character, next);
  std::vector<std::vector<int>> found = held_gaits(character, cost, next, steps);
};

// The feet that come down in the frames of a gait, by the contacts.
std::vector<int> footfalls(const Character& c, const std::vector<int>& gait) {
  std::vector<int> sides;
  for (const int fragment : gait) {
    const Fragment& f = c.pool.fragments[fragment];
    for (int frame = f.first_played(); frame < f.last_played(); ++frame) {
      for (int side = 0; side < 2; ++side) {
        const std::vector<bool>& stands = c.contacts[f.clip].feet[side];
        if (stands[frame + 1] && !stands[frame]) sides.push_back(side);
      }
    }
  }
  return sides;
}

TEST(HeldGaits, AreFragmentsThatFollowEachOtherAsAskedOnFeetInTurns) {
  const Gaits gaits(*gait_character());
  const Character& c = gaits.character;
  int held = 0;
  for (int control = 0; control < c.space.size(); ++control) {
    const std::vector<int>& gait = gaits.found[control];
    const Control& asked = c.space.point(control);
    if (asked.jumps() || asked.speed() == 0) EXPECT_TRUE(gait.empty());
    if (gait.empty()) continue;
    ++held;
    for (std::size_t i = 0; i < gait.size(); ++i) {
      EXPECT_TRUE(answers(c.pool.fragments[gait[i]].evident, asked));
      if (i > 0) EXPECT_EQ(gaits.next[gait[i - 1]], gait[i]);
    }
    const std::vector<int> sides = footfalls(c, gait);
    ASSERT_FALSE(sides.empty());
    EXPECT_EQ(sides.size() % 2, 0U);
    for (std::size_t i = 0; i < sides.size(); ++i) EXPECT_NE(sides[i], sides[(i + 1) % sides.size()]);
  }
  EXPECT_GT(held, 24) << "of 48";
}

// Of cycles of one fragment, or of two, none costs less.
TEST(HeldGaits, CostLeast) {
  const Gaits gaits(*gait_character());
  const Character& c = gaits.character;
  const auto cost_of = [&](const std::vector<int>& gait, const Control& control) {
    Control sum;
    double seconds = 0;
    for (const int fragment : gait) {
      const Fragment& f = c.pool.fragments[fragment];
      const double lasts = c.pool.seconds(f);
      seconds += lasts;
      sum.x += lasts * f.evident.x, sum.y += lasts * f.evident.y;
      sum.turn += lasts * f.evident.turn, sum.jump += lasts * f.evident.jump;
    }
    const Control mean{sum.x / seconds, sum.y / seconds, sum.turn / seconds, sum.jump / seconds};
    return gaits.cost.of_performing(mean, gait.front(), control) +
           gaits.cost.of_closing(gaits.next[gait.back()], gait.front(), seconds);
  };
  int compared = 0;
  for (int control = 0; control < c.space.size(); ++control) {
    if (gaits.found[control].empty()) continue;
    const Control& asked = c.space.point(control);
    const float least = cost_of(gaits.found[control], asked);
    for (int f = 0; f < static_cast<int>(gaits.next.size()); ++f) {
      const int second = gaits.next[f];
      if (second < 0 || gaits.next[second] < 0) continue;
      if (!gaits.cost.may_go_on(f, asked) || !gaits.cost.may_go_on(second, asked)) continue;
      if (footfalls(c, {f, second}) != std::vector<int>{0, 1}) continue;
      EXPECT_GE(cost_of({f, second}, asked), least - 1e-4);
      ++compared;
    }
  }
  EXPECT_GT(compared, 100);
}

TEST(HeldGaits, AreNotHopsOnBothFeet) {
  Gaits gaits(*gait_character());
  for (EntrySteps& entry : gaits.steps) entry.strikes[1] = entry.strikes[0] + 0.02F;
  for (const std::vector<int>& gait : held_gaits(gaits.character, gaits.cost, gaits.next, gaits.steps))
    EXPECT_TRUE(gait.empty());
}

// With a few classes, whose representatives tell little of what their members do.
TEST(HeldGaits, ArePlayedWhereAControlIsHeld) {
  BuildOptions options;
  options.classes = 8;
  options.policies = {"anticipate"};
  const auto character = std::make_shared<const Character>(
      build(humanoid(), gait_takes(), {simulate_trace("explorer", 30, 1, ControlSpace())}, options));
  const Gaits gaits(*character);
  int plays = 0, all = 0;
  for (int control = 0; control < character->space.size(); ++control) {
    const std::vector<int>& gait = gaits.found[control];
    if (gait.empty()) continue;
    Player player(character);
    for (int frame = 0; frame < 600; ++frame) player.step(character->space.point(control), 1.0 / 60);
    ++all;
    plays += std::count(gait.begin(), gait.end(), player.playing_fragment()) > 0 ? 1 : 0;
  }
  EXPECT_GT(plays, 0.5 * all) << plays << " of " << all;
}

}  // namespace
}  // namespace fragmotion

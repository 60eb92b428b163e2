// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

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
  float variety = static_cast<float>(TransitionWeights().variety);
  std::vector<std::vector<int>> found = held_gaits(character, cost, next, steps, variety);
};

bool is_made(const Character& c, int fragment) { return is_made(c.pool.fragments[fragment].origin); }

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

bool in_turns(const std::vector<int>& sides) {
  if (sides.empty() || sides.size() % 2 != 0) return false;
  for (std::size_t i = 0; i < sides.size(); ++i) {
    if (sides[i] == sides[(i + 1) % sides.size()]) return false;
  }
  return true;
}

// What a cycle costs, and how much of that it costs how it performs.
struct Cost {
  float whole = std::numeric_limits<float>::infinity(), performing = 0;
};

Cost cost_of(const Gaits& gaits, const std::vector<int>& cycle, const Control& control) {
  const Character& c = gaits.character;
  Control sum;
  double seconds = 0;
  for (const int fragment : cycle) {
    const Fragment& f = c.pool.fragments[fragment];
    const double lasts = c.pool.seconds(f);
    seconds += lasts;
    sum.x += lasts * f.evident.x, sum.y += lasts * f.evident.y;
    sum.turn += lasts * f.evident.turn, sum.jump += lasts * f.evident.jump;
  }
  const Control mean{sum.x / seconds, sum.y / seconds, sum.turn / seconds, sum.jump / seconds};
  const float performing = gaits.cost.of_performing(mean, cycle.front(), control);
  return {performing + gaits.cost.of_closing(gaits.next[cycle.back()], cycle.front(), seconds), performing};
}

// Of the cycles that begin with a fragment, the least cost, and that cycle.
Cost least_cost(const Gaits& gaits, int first, const Control& control, std::vector<int>* found = nullptr) {
  Cost least;
  std::vector<int> cycle;
  const std::vector<Fragment>& fragments = gaits.character.pool.fragments;
  for (int f = first; f >= 0 && gaits.cost.may_go_on(f, control) && cycle.size() < kLanes; f = gaits.next[f]) {
    if (!goes_along(fragments[f].evident.x, fragments[f].evident.y, control)) break;
    cycle.push_back(f);
    if (gaits.next[f] < 0 || !in_turns(footfalls(gaits.character, cycle))) continue;
    const Cost cost = cost_of(gaits, cycle, control);
    if (cost.whole >= least.whole) continue;
    least = cost;
    if (found != nullptr) *found = cycle;
  }
  return least;
}

TEST(HeldGaits, BeginCyclesAsAskedOnFeetInTurnsOrAreAMadeOne) {
  const Gaits gaits(*gait_character());
  const Character& c = gaits.character;
  int held = 0, made = 0;
  for (int control = 0; control < c.space.size(); ++control) {
    const std::vector<int>& gait = gaits.found[control];
    const Control& asked = c.space.point(control);
    if (asked.jumps() || asked.speed() == 0) EXPECT_TRUE(gait.empty());
    if (gait.empty()) continue;
    ++held;
    for (const int first : gait) {
      EXPECT_TRUE(answers(c.pool.fragments[first].evident, asked));
      if (!is_made(c, gait.front())) EXPECT_LT(least_cost(gaits, first, asked).whole, 100) << "a cycle begins with it";
    }
    if (!is_made(c, gait.front())) continue;
    ++made;
    for (std::size_t i = 1; i < gait.size(); ++i) EXPECT_EQ(gaits.next[gait[i - 1]], gait[i]);
    EXPECT_TRUE(in_turns(footfalls(c, gait)));
  }
  EXPECT_GT(held, 24) << "of 48";
  EXPECT_GT(made, 0);
  EXPECT_LT(made, held);
}

// Of all cycles none costs less than the best one; and where that is captured, a gait has those of its take that cost
// nearly as little, perform as asked for no more than the best one costs in whole, and join on to the best one.
TEST(HeldGaits, CostLeastOrNearly) {
  const Gaits gaits(*gait_character());
  const Character& c = gaits.character;
  int several = 0;
  for (int control = 0; control < c.space.size(); ++control) {
    const std::vector<int>& gait = gaits.found[control];
    if (gait.empty()) continue;
    const Control& asked = c.space.point(control);
    std::vector<int> cycle;
    const float best = least_cost(gaits, gait.front(), asked, &cycle).whole;
    const bool made = is_made(c, gait.front());
    const float most = best + gaits.variety;
    several += made || gait.size() == 1 ? 0 : 1;
    for (int f = 0; f < static_cast<int>(gaits.next.size()); ++f) {
      const Cost cost = least_cost(gaits, f, asked);
      EXPECT_GE(cost.whole, best - 1e-4);
      if (made || std::abs(cost.whole - most) < 1e-4 || std::abs(cost.performing - best) < 1e-4) continue;
      const bool is_of_take = c.pool.fragments[f].clip == c.pool.fragments[gait.front()].clip;
      float apart = std::numeric_limits<float>::infinity();
      for (const int each : cycle) apart = std::min(apart, gaits.cost.of_joining(gaits.cost.beside(each, f), 0));
      const bool belongs = is_of_take && cost.whole < most && cost.performing < best && apart <= gaits.variety;
      EXPECT_EQ(std::count(gait.begin(), gait.end(), f), belongs ? 1 : 0) << cost.whole << " " << most;
    }
  }
  EXPECT_GT(several, 3);
}

TEST(HeldGaits, AreNotHopsOnBothFeet) {
  Gaits gaits(*gait_character());
  for (EntrySteps& entry : gaits.steps) entry.strikes[1] = entry.strikes[0] + 0.02F;
  for (const std::vector<int>& gait : held_gaits(gaits.character, gaits.cost, gaits.next, gaits.steps, gaits.variety))
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
    std::vector<int> cycles = gait;
    for (const int first : gait) {
      for (int i = 1, f = gaits.next[first]; f >= 0 && i < kLanes; ++i, f = gaits.next[f]) cycles.push_back(f);
    }
    ++all;
    plays += std::count(cycles.begin(), cycles.end(), player.playing_fragment()) > 0 ? 1 : 0;
  }
  EXPECT_GT(plays, 0.5 * all) << plays << " of " << all;
}

// A take that is shown long enough is not gone round in one of its cycles.
TEST(HeldGaits, VaryWhereATakeGoesAsAsked) {
  const Gaits gaits(*gait_character());
  const Character& c = gaits.character;
  int varied = 0, captured = 0;
  for (int control = 0; control < c.space.size(); ++control) {
    const std::vector<int>& gait = gaits.found[control];
    if (gait.empty() || is_made(c, gait.front())) continue;
    Player player(gait_character());
    std::set<int> played;
    for (int frame = 0; frame < 3600; ++frame) {
      player.step(c.space.point(control), 1.0 / 60);
      if (frame > 300) played.insert(player.playing_fragment());
    }
    ++captured;
    varied += played.size() > kLanes ? 1 : 0;
  }
  EXPECT_GT(varied, 0.3 * captured) << varied << " of " << captured;
}

}  // namespace
}  // namespace fragmotion

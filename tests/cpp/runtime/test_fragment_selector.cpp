// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "build/exclude_classes.hpp"
#include "fragments/body_tips.hpp"
#include "fragments/hips_velocity.hpp"
#include "fragments/successors.hpp"
#include "policy/answer.hpp"
#include "runtime/fragment_selector.hpp"
#include "small_character.hpp"
#include "split_bones.hpp"

namespace fragmotion {
namespace {

// What chooses after a fragment that plays.
struct Choice {
  std::shared_ptr<const Character> character;
  Workspace workspace{*character};
  Playback playback{*character, workspace, Stitching::inertialize, 0.2};
  FragmentSelector selector;

  explicit Choice(std::uint64_t seed, std::shared_ptr<const Character> of = gait_character())
      : character(std::move(of)), selector(workspace, seed) {
    playback.reset(0, {});
  }
};

// The stated perform() of a fragment.
double stated_performing(const Choice& choice, int fragment, const Control& control) {
  const Character& c = *choice.character;
  const TransitionWeights weights;
  const Fragment& f = c.pool.fragments[fragment];
  const bool made = f.origin == Origin::interpolated || f.origin == Origin::transformed;
  return weights.match * c.space.distance(f.evident, control) + weights.bent * std::abs(f.evident.turn - control.turn) +
         (made ? weights.manner : 0);
}

// Its stated equation, of a fragment that is entered from what plays; how the tips would go on is the selector's.
double stated_cost(const Choice& choice, const std::vector<EndVelocities>& ends, int fragment, const Control& control) {
  const Character& c = *choice.character;
  const TransitionWeights weights;
  const Fragment &f = c.pool.fragments[fragment], &left = choice.playback.fragment();
  const auto moves = [&](const Control& evident) { return evident.speed() * c.space.scale() > kMoving; };
  double cost = stated_performing(choice, fragment, control);
  cost += weights.unsteady * standard_scale(c.pool.skeleton) * (ends[fragment].last - ends[fragment].first).norm();
  cost += weights.hurried * std::max(0.0, 1 - c.pool.seconds(f) / 0.4);
  if ((f.origin == Origin::mirrored) != (left.origin == Origin::mirrored)) cost += weights.manner;
  if (f.clip != left.clip) cost += weights.manner;
  if (moves(f.evident) && moves(left.evident)) {
    cost += weights.out_of_turn *
            steps_out_of_turn(choice.playback.steps(), choice.workspace.styles->front().entry_steps[fragment]);
  }
  const std::vector<float>& onward = choice.workspace.onward;
  const int stride = static_cast<int>(onward.size()) / 3;
  const double distance = tip_distance(onward.data(), &c.entry_poses[onward.size() * fragment], stride) / 2;
  return cost + distance * kTunedReach / tip_reach(c.pool.skeleton);
}

constexpr int kDraws = 200;  // so that each of some members is drawn

TEST(TransitionCost, LetsATakeTurnOnTheSpotOnlyWhereThatIsAsked) {
  const std::shared_ptr<const Character> character = gait_character();
  const TransitionCost cost(*character, TransitionWeights());
  int turning = 0, standing = 0;
  for (std::size_t f = 0; f < character->pool.fragments.size(); ++f) {
    const Control& evident = character->pool.fragments[f].evident;
    if (evident.speed() > 0.1 || evident.jumps()) continue;
    for (const double asked : {-1.0, 0.0, 1.0}) {
      const bool fits = std::abs(evident.turn - asked) < 0.5;
      EXPECT_EQ(cost.may_go_on(static_cast<int>(f), {0, 0, asked, 0}), fits) << f << " " << asked;
      turning += fits && asked != 0, standing += fits && asked == 0;
    }
  }
  EXPECT_GT(turning, 5);
  EXPECT_GT(standing, 5);
}

TEST(FragmentSelector, ChoosesMembersThatCostNearlyAsLittleAsAnyByTheStatedEquation) {
  Choice choice(3);
  const Character& c = *choice.character;
  const std::vector<EndVelocities> ends = end_velocities(c.pool);
  choice.playback.advance(0.1);
  const auto members = c.classes.members();
  for (int k = 0; k < c.classes.count; k += 2) {
    for (int point = 0; point < kPaperPoints; point += 14) {
      const Control control = c.space.point(point);
      const int chosen = choice.selector.choose(k, control, choice.playback);
      EXPECT_EQ(c.classes.labels[chosen], k);
      const Control& usual = c.pool.fragments[c.classes.representatives[k]].evident;
      const bool goes = control.speed() * c.space.scale() > kMoving && answers(usual, control);
      const auto may_play = [&](const Control& evident) {
        return (!matches_jump(usual, control) || matches_jump(evident, control)) &&
               (!goes || answers(evident, control));
      };
      EXPECT_TRUE(may_play(c.pool.fragments[chosen].evident));
      double least = std::numeric_limits<double>::infinity();
      std::vector<std::pair<double, int>> costs;
      for (const int member : members[k]) {
        if (may_play(c.pool.fragments[member].evident))
          costs.emplace_back(stated_cost(choice, ends, member, control), member);
      }
      for (const auto& [cost, member] : costs) least = std::min(least, cost);
      EXPECT_LE(stated_cost(choice, ends, chosen, control), least + TransitionWeights{}.variety + 1e-4);
      EXPECT_NEAR(choice.selector.cost_of_leaving({k, -1}, control, choice.playback).whole, least, 1e-4);
      std::set<int> drawn;
      for (int draw = 0; draw < kDraws; ++draw) drawn.insert(choice.selector.choose(k, control, choice.playback));
      for (const auto& [cost, member] : costs) {
        const double over = cost - least - TransitionWeights{}.variety;
        if (std::abs(over) > 1e-4) {
          EXPECT_EQ(drawn.count(member), over < 0 ? 1 : 0) << k << " " << point;
        }
      }
    }
  }
}

// A walk of 3 s, and one that slows down evenly over as long.
std::shared_ptr<const Character> braking_character() {
  Gait walk;
  walk.rate = 60;
  walk.seconds = 6;
  const Clip steady = gait_clip(walk);
  Clip brakes = part(steady, 0, 0);
  const auto row = [&](std::vector<double>& to, const std::vector<double>& from, int at) {
    const auto width = static_cast<std::ptrdiff_t>(from.size()) / steady.frames;
    to.insert(to.end(), from.begin() + width * at, from.begin() + width * (at + 1));
  };
  for (double t = 1 / walk.rate; t < 3; t += 1 / walk.rate) {
    const int at = static_cast<int>(std::lround((t - t * t / 6) * walk.rate));
    row(brakes.root_positions, steady.root_positions, at);
    row(brakes.headings, steady.headings, at);
    row(brakes.rotations, steady.rotations, at);
    ++brakes.frames;
  }
  BuildOptions options;
  options.classes = 6;
  options.synthesize = false;
  options.policies = {"greedy"};
  return std::make_shared<const Character>(
      build(humanoid(), {part(steady, 0, 180), brakes}, {simulate_trace("explorer", 10, 1, ControlSpace())}, options));
}

TEST(FragmentSelector, CountsWhatStraysFromTheControlWhereATakeGoesOnToo) {
  const Choice choice(1, braking_character());
  const Character& c = *choice.character;
  const std::vector<EndVelocities> ends = end_velocities(c.pool);
  int walking = 0, stopping = 0;
  for (int fragment = 0; fragment < static_cast<int>(ends.size()); ++fragment) {
    for (const Control& control : {Control{0, 1.2, 0, 0}, Control{}}) {
      const Vector2 asked{control.x, control.y};
      const double strays = std::max(0.0, (ends[fragment].last - asked).norm() - (ends[fragment].first - asked).norm()),
                   costs = TransitionWeights{}.unsteady * standard_scale(c.pool.skeleton) * strays;
      EXPECT_NEAR(choice.selector.cost_of_going_on(fragment, control),
                  stated_performing(choice, fragment, control) + costs, 1e-4);
      if (costs > 0.5) ++(control.speed() > 0 ? walking : stopping);
    }
  }
  EXPECT_GT(walking, 3) << "steps that brake under a walk that is held";
  EXPECT_EQ(stopping, 0) << "under a stop they are asked for";
}

TEST(FragmentSelector, DrawsTheSameFromTheSameSeedAndAfterAReset) {
  Choice one(5), two(5);
  std::vector<int> first, second, again;
  for (int k = 0; k < one.character->classes.count; ++k) {
    first.push_back(one.selector.choose_any(k));
    second.push_back(two.selector.choose_any(k));
  }
  one.selector.reset();
  for (int k = 0; k < one.character->classes.count; ++k) again.push_back(one.selector.choose_any(k));
  EXPECT_EQ(first, second);
  EXPECT_EQ(first, again);
}

// When what plays is left for a class, where a second of waiting costs so much and nothing else may play.
double exit_of(const Choice& choice, int next_class, const Control& control, double haste) {
  const Exit none{-1, 0, std::numeric_limits<double>::infinity()};
  return choice.selector.best_exit({Exit{next_class, 0, 0}, none}, control, choice.playback, haste, none).seconds;
}

TEST(FragmentSelector, LeavesAFragmentWithinItsTimeAndAtOnceWhereWaitingCostsMuch) {
  Choice choice(1);
  const Character& c = *choice.character;
  std::set<double> moments;
  for (int fragment = 0; fragment < static_cast<int>(c.pool.fragments.size()); fragment += 29) {
    choice.playback.reset(fragment, {});
    choice.playback.advance(0.04);
    const double end = choice.playback.seconds() + choice.playback.left();
    for (int k = 0; k < c.classes.count; k += 5) {
      const Control& control = c.pool.fragments[c.classes.representatives[k]].evident;
      const double free = exit_of(choice, k, control, 0);
      EXPECT_GE(free, choice.playback.seconds());
      EXPECT_LE(free, end + 1e-9);
      EXPECT_EQ(exit_of(choice, k, control, 1e9), choice.playback.seconds());
      moments.insert(free);
    }
  }
  EXPECT_GT(moments.size(), 5U);
}

TEST(FragmentSelector, LeavesAFragmentOnlyWhereThatCostsLessThanWhatElseMayPlay) {
  Choice choice(1);
  const Character& c = *choice.character;
  choice.playback.advance(0.04);
  for (int k = 0; k < c.classes.count; k += 5) {
    const Control& control = c.pool.fragments[c.classes.representatives[k]].evident;
    const Exit free = {-1, 0, std::numeric_limits<double>::infinity()};
    const auto best = [&](double more, double cost) {
      return choice.selector.best_exit({Exit{k, 0, more}, free}, control, choice.playback, 1, Exit{k, 7, cost});
    };
    const double least = best(0, 1e9).cost;
    EXPECT_LT(least, 1e9);
    EXPECT_NEAR(best(2, 1e9).cost, least + 2, 1e-3);
    EXPECT_EQ(best(0, least - 1e-3).seconds, 7);
    EXPECT_LT(best(0, least + 1e-3).seconds, 7);
  }
}

TEST(FragmentSelector, TellsWhetherToLeaveNowAsAWholePlanDoes) {
  Choice choice(1);
  const Character& c = *choice.character;
  const Exit none{-1, 0, std::numeric_limits<double>::infinity()};
  int now = 0, later = 0;
  for (int fragment = 0; fragment < static_cast<int>(c.pool.fragments.size()); fragment += 29) {
    choice.playback.reset(fragment, {});
    choice.playback.advance(0.04);
    for (int k = 0; k + 1 < c.classes.count; k += 5) {
      const Control& control = c.pool.fragments[c.classes.representatives[k]].evident;
      for (const double haste : {0.0, 2.0, 20.0}) {
        const Exit stays{k, choice.playback.seconds() + choice.playback.left(), k % 2 == 0 ? 3 : none.cost};
        const auto best = [&](bool only_now) {
          return choice.selector.best_exit({Exit{k, 0, 0}, Exit{k + 1, 0, 0.2}}, control, choice.playback, haste, stays,
                                           only_now);
        };
        const Exit whole = best(false), found = best(true);
        const bool leaves = whole.seconds == choice.playback.seconds();
        ASSERT_EQ(found.seconds == choice.playback.seconds(), leaves);
        if (leaves) ASSERT_EQ(found.next_class, whole.next_class);
        ++(leaves ? now : later);
      }
    }
  }
  EXPECT_GT(now, 50);
  EXPECT_GT(later, 50);
}

// When a fragment is left for a class whose representative performs the control.
double exit_for(Choice& choice, int fragment, int next_class) {
  constexpr double kSoon = 0.1, kHaste = 0.5 * kTunedReach;  // s, and m of Dis
  const Character& c = *choice.character;
  const Control& control = c.pool.fragments[c.classes.representatives[next_class]].evident;
  choice.playback.reset(fragment, {});
  choice.playback.advance(kSoon);
  return exit_of(choice, next_class, control, kHaste) - kSoon;
}

// Dis itself is not quite the same of other bones, so that a few moments that are hardly better than others change.
TEST(FragmentSelector, LeavesAFragmentAtTheSameMomentWhereTheSameLimbsAreOfMoreBones) {
  Choice whole(1), split(1, with_split_bones(*gait_character()));
  const Character& c = *whole.character;
  int exits = 0, same = 0;
  double waited = 0, waited_of_split = 0;
  for (int fragment = 0; fragment < static_cast<int>(c.pool.fragments.size()); fragment += 3) {
    for (int k = 0; k < c.classes.count; ++k) {
      const double one = exit_for(whole, fragment, k), other = exit_for(split, fragment, k);
      ++exits;
      same += std::abs(one - other) < 1e-9 ? 1 : 0;
      waited += one;
      waited_of_split += other;
    }
  }
  EXPECT_GT(same, 0.96 * exits);
  EXPECT_GT(waited / exits, 0.005);
  EXPECT_NEAR(waited_of_split / waited, 1, 0.2);
}

// How many feet come down out of turn in all where fragments are left early for classes.
int steps_out_of_turn_when_left(Choice& choice, bool known) {
  int all = 0;
  const Character& c = *choice.character;
  if (!known) {
    std::vector<FragmentLists> lists = *choice.workspace.styles;
    lists[0].entry_steps.assign(c.pool.fragments.size(), EntrySteps{});
    choice.workspace.styles = std::make_shared<const std::vector<FragmentLists>>(std::move(lists));
    choice.selector.change_style(0);
  }
  const std::vector<EntrySteps> entries = entry_steps(c, successors(c.pool.fragments));
  for (int fragment = 0; fragment < static_cast<int>(c.pool.fragments.size()); fragment += 3) {
    if (!(c.pool.fragments[fragment].evident.speed() > kMoving)) continue;
    for (int k = 0; k < c.classes.count; ++k) {
      const int representative = c.classes.representatives[k];
      const Control& control = c.pool.fragments[representative].evident;
      if (!(control.speed() > kMoving)) continue;
      choice.playback.reset(representative, {});
      choice.playback.advance(choice.playback.left());
      choice.playback.start(fragment);
      choice.playback.advance(0.1);
      choice.playback.advance(exit_of(choice, k, control, 0.1 * kTunedReach) - choice.playback.seconds());
      const int chosen = choice.selector.choose(k, control, choice.playback);
      all += steps_out_of_turn(choice.playback.steps(), entries[chosen]);
    }
  }
  return all;
}

TEST(FragmentSelector, LeavesAFragmentWhereFeetComeDownInTurn) {
  Choice knows(1), does_not(1);
  EXPECT_LT(steps_out_of_turn_when_left(knows, true), steps_out_of_turn_when_left(does_not, false));
}

// Or a body whose stick is let go would go on for as long as its take does.
TEST(FragmentSelector, GoesOnInTheTakeWhereThatJumpsGoesAndStopsAsAsked) {
  Choice choice(1);
  const Character& c = *choice.character;
  const std::vector<int> next = successors(c.pool.fragments);
  const std::vector<EndVelocities> ends = end_velocities(c.pool);
  int stays = 0, leaves = 0, goes_on_without_a_stick = 0;
  for (int fragment = 0; fragment < static_cast<int>(next.size()); fragment += 3) {
    for (int point = 0; point < kPaperPoints; point += 5) {
      const Control& control = c.space.point(point);
      const int found = choice.selector.successor(fragment, control);
      const int after = next[fragment];
      const bool turns = after >= 0 && std::abs(c.pool.fragments[after].evident.turn - control.turn) >= 0.5;
      const bool stands = after >= 0 && !turns &&
                          (c.pool.fragments[after].evident.speed() * c.space.scale() <= kMoving ||
                           ends[after].last.norm() <= ends[after].first.norm() / 2);
      const bool may = after >= 0 && matches_jump(c.pool.fragments[after].evident, control) &&
                       (control.speed() == 0 ? stands : answers(c.pool.fragments[after].evident, control));
      EXPECT_EQ(found, may ? after : -1);
      (found < 0 ? leaves : stays) += 1;
      if (after >= 0 && control.speed() == 0 && !stands) ++goes_on_without_a_stick;
    }
  }
  EXPECT_GT(goes_on_without_a_stick, 20);
  EXPECT_GT(stays, 20);
  EXPECT_GT(leaves, stays);
}

TEST(FragmentSelector, GoesOnWithNoClassThatIsLeftOut) {
  Choice whole(1);
  const Character& c = *whole.character;
  const std::vector<int> next = successors(c.pool.fragments);
  const int fragment =
      static_cast<int>(std::find_if(next.begin(), next.end(), [](int f) { return f >= 0; }) - next.begin());
  const int entered = c.classes.labels[next[fragment]];
  const Control& control = c.pool.fragments[next[fragment]].evident;
  ASSERT_EQ(whole.selector.successor(fragment, control), next[fragment]);
  Choice without(1, std::make_shared<const Character>(without_classes(c, {entered})));
  EXPECT_EQ(without.selector.successor(fragment, control), -1);
}

}  // namespace
}  // namespace fragmotion

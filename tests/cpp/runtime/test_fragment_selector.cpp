// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "build/exclude_classes.hpp"
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

TEST(FragmentSelector, ChoosesMembersThatPerformTheControlNearlyAsWellAndSteadilyAsTheRepresentative) {
  Choice choice(3);
  const Character& c = *choice.character;
  for (int k = 0; k < c.classes.count; ++k) {
    for (int point = 0; point < kPaperPoints; point += 7) {
      const Control control = c.space.point(point);
      const int chosen = choice.selector.choose(k, control, choice.playback);
      EXPECT_EQ(c.classes.labels[chosen], k);
      const int representative = c.classes.representatives[k];
      const Control &its = c.pool.fragments[chosen].evident, &usual = c.pool.fragments[representative].evident;
      EXPECT_LE(choice.selector.error(chosen, control),
                choice.selector.error(representative, control) + FragmentSelector::kNearly);
      if (matches_jump(usual, control)) EXPECT_TRUE(matches_jump(its, control));
    }
  }
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

TEST(FragmentSelector, LeavesAFragmentWithinItsTimeAndAtOnceWhereWaitingCostsMuch) {
  Choice choice(1);
  const Character& c = *choice.character;
  std::set<double> moments;
  for (int fragment = 0; fragment < static_cast<int>(c.pool.fragments.size()); fragment += 53) {
    choice.playback.reset(fragment, {});
    choice.playback.advance(0.04);
    const double end = choice.playback.seconds() + choice.playback.left();
    for (int k = 0; k < c.classes.count; k += 5) {
      const Control& control = c.pool.fragments[c.classes.representatives[k]].evident;
      const double free = choice.selector.best_exits({k, -1}, control, choice.playback, 0)[0].seconds;
      EXPECT_GE(free, choice.playback.seconds());
      EXPECT_LE(free, end + 1e-9);
      EXPECT_EQ(choice.selector.best_exits({k, -1}, control, choice.playback, 1e9)[0].seconds,
                choice.playback.seconds());
      moments.insert(free);
    }
  }
  EXPECT_GT(moments.size(), 5U);
}

// When a fragment is left for a class whose representative performs the control.
double exit_for(Choice& choice, int fragment, int next_class) {
  constexpr double kSoon = 0.1, kHaste = 0.5;  // s, and m a metre of reach
  const Character& c = *choice.character;
  const Control& control = c.pool.fragments[c.classes.representatives[next_class]].evident;
  choice.playback.reset(fragment, {});
  choice.playback.advance(kSoon);
  return choice.selector.best_exits({next_class, -1}, control, choice.playback, kHaste)[0].seconds - kSoon;
}

// Dis itself is not quite the same of other bones, so that a few moments that are hardly better than others change.
TEST(FragmentSelector, LeavesAFragmentAtTheSameMomentWhereTheSameLimbsAreOfMoreBones) {
  Choice whole(1), split(1, with_split_bones(*gait_character()));
  const Character& c = *whole.character;
  int exits = 0, same = 0;
  double waited = 0, waited_of_split = 0;
  for (int fragment = 0; fragment < static_cast<int>(c.pool.fragments.size()); fragment += 5) {
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
  if (!known) choice.workspace.styles[0].entry_steps.assign(c.pool.fragments.size(), EntrySteps{});
  const std::vector<EntrySteps> entries = entry_steps(c);
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
      const Exit exit = choice.selector.best_exits({k, -1}, control, choice.playback, 0.1)[0];
      choice.playback.advance(exit.seconds - choice.playback.seconds());
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

// A take is gone on with where its own next fragment performs the control nearly as well as the class would.
TEST(FragmentSelector, GoesOnInTheTakeWhereThatPerformsTheControlNearlyAsWell) {
  Choice choice(1);
  const Character& c = *choice.character;
  const std::vector<int> next = successors(c.pool.fragments);
  int stays = 0, leaves = 0;
  for (int fragment = 0; fragment < static_cast<int>(next.size()); fragment += 3) {
    for (int k = 0; k < c.classes.count; ++k) {
      const int representative = c.classes.representatives[k];
      const Control& control = c.pool.fragments[representative].evident;
      const int found = choice.selector.continuation(fragment, k, control);
      (found < 0 ? leaves : stays) += 1;
      if (found < 0) continue;
      EXPECT_EQ(found, next[fragment]);
      const Control& evident = c.pool.fragments[found].evident;
      EXPECT_TRUE(matches_jump(evident, control));
      EXPECT_TRUE(control.speed() <= kMoving || answers(evident, control));
      EXPECT_LE(c.space.distance(evident, control),
                choice.selector.error(representative, control) + FragmentSelector::kNearly);
    }
  }
  EXPECT_GT(stays, 20);
  EXPECT_GT(leaves, stays);
}

// What is foretold of a fragment's end is what is measured there.
TEST(FragmentSelector, ForetellsHowAClassJoinsOnToAFragmentsEnd) {
  Choice choice(1);
  const Character& c = *choice.character;
  for (int fragment = 0; fragment < static_cast<int>(c.pool.fragments.size()); fragment += 17) {
    choice.playback.reset(fragment, {});
    StepSequence steps = choice.playback.steps();
    const double rate = c.pool.clips[choice.playback.fragment().clip].rate;
    const int frames = choice.playback.fragment().last_played() - choice.playback.fragment().first_played();
    for (int frame = 0; frame < frames; ++frame) choice.playback.advance(1 / rate);
    for (int k = 0; k < c.classes.count; k += 5) {
      const Control& control = c.pool.fragments[c.classes.representatives[k]].evident;
      EXPECT_NEAR(choice.selector.distance_after(fragment, k, control, steps),
                  choice.selector.distance_to_class(k, control, choice.playback), 1e-5);
    }
  }
}

TEST(FragmentSelector, GoesOnWithNoClassThatIsLeftOut) {
  Choice whole(1);
  const Character& c = *whole.character;
  const std::vector<int> next = successors(c.pool.fragments);
  const int fragment =
      static_cast<int>(std::find_if(next.begin(), next.end(), [](int f) { return f >= 0; }) - next.begin());
  const int entered = c.classes.labels[next[fragment]];
  const Control& control = c.pool.fragments[next[fragment]].evident;
  ASSERT_EQ(whole.selector.continuation(fragment, entered, control), next[fragment]);
  Choice without(1, std::make_shared<const Character>(without_classes(c, {entered})));
  EXPECT_EQ(without.selector.continuation(fragment, c.classes.labels[fragment], control), -1);
}

}  // namespace
}  // namespace fragmotion

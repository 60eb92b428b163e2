// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "fragmotion/runtime/fragment_selector.hpp"
#include "small_character.hpp"

namespace fragmotion {
namespace {

// What chooses after a fragment that plays.
struct Choice {
  std::shared_ptr<const Character> character = gait_character();
  Workspace workspace{*character};
  Playback playback{*character, workspace, Stitching::inertialize, 0.2};
  FragmentSelector selector;

  explicit Choice(std::uint64_t seed, int playing = 0) : selector(*character, workspace, seed) {
    playback.reset(playing, {});
  }
};

TEST(FragmentSelector, ChoosesMembersThatPerformTheControlAtLeastAsWellAsTheRepresentative) {
  Choice choice(3);
  const Character& c = *choice.character;
  for (int k = 0; k < c.classes.count; ++k) {
    for (int point = 0; point < ControlSpace::kPoints; point += 7) {
      const Control control = c.space.point(point);
      const int chosen = choice.selector.choose(k, control, choice.playback);
      EXPECT_EQ(c.classes.labels[chosen], k);
      const Control &its = c.pool.fragments[chosen].evident,
                    &usual = c.pool.fragments[c.classes.representatives[k]].evident;
      EXPECT_LE(c.space.distance(its, control), c.space.distance(usual, control) + 1e-12);
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
      const double free = choice.selector.best_exit(k, control, choice.playback, 0);
      EXPECT_GE(free, choice.playback.seconds());
      EXPECT_LE(free, end + 1e-9);
      EXPECT_EQ(choice.selector.best_exit(k, control, choice.playback, 1e9), choice.playback.seconds());
      moments.insert(free);
    }
  }
  EXPECT_GT(moments.size(), 5U);
}

}  // namespace
}  // namespace fragmotion

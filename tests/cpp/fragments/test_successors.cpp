// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>

#include "fragments/successors.hpp"
#include "small_character.hpp"

namespace fragmotion {
namespace {

TEST(Successors, BeginWhereTheFragmentEndsInTheSameClip) {
  const PackedPool& pool = gait_character()->pool;
  const std::vector<int> found = successors(pool.fragments);
  ASSERT_EQ(found.size(), pool.fragments.size());
  for (std::size_t f = 0; f < found.size(); ++f) {
    const Fragment& one = pool.fragments[f];
    const auto follows = [&](const Fragment& other) {
      return other.clip == one.clip && other.origin == one.origin && other.first_played() == one.last_played();
    };
    const auto first = std::find_if(pool.fragments.begin(), pool.fragments.end(), follows);
    if (first == pool.fragments.end() && one.origin == Origin::transformed && !one.evident.jumps()) continue;
    EXPECT_EQ(found[f], first == pool.fragments.end() ? -1 : first - pool.fragments.begin());
  }
  EXPECT_GT(std::count_if(found.begin(), found.end(), [](int next) { return next >= 0; }), found.size() / 2);
}

TEST(Successors, OfGaitsAndStandsThatWereMadeComeRoundAgain) {
  const PackedPool& pool = gait_character()->pool;
  const std::vector<int> found = successors(pool.fragments);
  int rounds = 0;
  for (std::size_t f = 0; f < found.size(); ++f) {
    if (pool.fragments[f].origin != Origin::transformed) continue;
    if (pool.fragments[f].evident.jumps()) {
      EXPECT_EQ(found[f], -1) << "a hop is no cycle";
      continue;
    }
    std::size_t at = f;
    int seen = 0;
    do at = found[at], ++seen;
    while (at != f && seen <= 100);
    EXPECT_EQ(at, f);
    EXPECT_EQ(seen, std::count_if(pool.fragments.begin(), pool.fragments.end(),
                                  [&](const Fragment& other) { return other.clip == pool.fragments[f].clip; }));
    rounds += 1;
  }
  EXPECT_GT(rounds, 20);
}

TEST(Successors, OfNoFragmentsAreNone) { EXPECT_TRUE(successors({}).empty()); }

}  // namespace
}  // namespace fragmotion

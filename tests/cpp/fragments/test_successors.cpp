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
    EXPECT_EQ(found[f], first == pool.fragments.end() ? -1 : first - pool.fragments.begin());
  }
  EXPECT_GT(std::count_if(found.begin(), found.end(), [](int next) { return next >= 0; }), found.size() / 2);
}

TEST(Successors, OfNoFragmentsAreNone) { EXPECT_TRUE(successors({}).empty()); }

}  // namespace
}  // namespace fragmotion

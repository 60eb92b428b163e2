// SPDX-License-Identifier: MIT
// An animal that sits or lies does not stand.
#include <gtest/gtest.h>

#include "dog.hpp"
#include "fragments/lying.hpp"

namespace fragmotion {
namespace {

// `clip` and, as another, the same sunk by so many metres.
FragmentPool cut_with_a_sunk_one(const Skeleton& skeleton, const Clip& clip, double sunk) {
  Clip low = clip;
  low.name = "low";
  for (int f = 0; f < low.frames; ++f) low.root_positions[std::size_t{3} * f + 2] -= sunk;
  FragmentPool pool{skeleton, {clip, clip, low}, {}};
  const Kinematics kinematics(skeleton);
  for (int c = 0; c < 3; ++c) cut_fragments(pool, c, find_contacts(kinematics, pool.clips[c]), {}, {});
  return pool;
}

TEST(Lying, ADogsFragmentsAreLeftOut) {
  const Skeleton skeleton = dog();
  FragmentPool pool = cut_with_a_sunk_one(skeleton, dog_clip({}, false, "walk"), 0.5);
  const std::vector<int> before = fragments_by_clip(pool);
  ASSERT_GT(before[2], 0);
  drop_lying(pool, 0);
  EXPECT_EQ(fragments_by_clip(pool), (std::vector<int>{before[0], before[1], 0}));
}

TEST(Lying, WhatStandsALittleLowerIsKept) {
  const Skeleton skeleton = dog();
  FragmentPool pool = cut_with_a_sunk_one(skeleton, dog_clip({}, false, "walk"), 0.1);
  const std::vector<int> before = fragments_by_clip(pool);
  drop_lying(pool, 0);
  EXPECT_EQ(fragments_by_clip(pool), before);
}

// As of a pack whose animals' origin is in their bellies: where the ground is, their feet tell.
TEST(Lying, NothingIsToldByWhereTheOriginIs) {
  const Skeleton skeleton = dog();
  Clip clip = dog_clip({}, false, "walk");
  for (int f = 0; f < clip.frames; ++f) clip.root_positions[std::size_t{3} * f + 2] -= 0.5;
  for (const double sunk : {0.0, 0.5}) {
    FragmentPool pool = cut_with_a_sunk_one(skeleton, clip, sunk);
    std::vector<int> left = fragments_by_clip(pool);
    if (sunk > 0) left[2] = 0;
    drop_lying(pool, 0);
    EXPECT_EQ(fragments_by_clip(pool), left);
  }
}

TEST(Lying, EarlierFragmentsStay) {
  const Skeleton skeleton = dog();
  FragmentPool pool = cut_with_a_sunk_one(skeleton, dog_clip({}, false, "walk"), 0.5);
  const std::size_t all = pool.fragments.size();
  drop_lying(pool, all - 1);
  EXPECT_EQ(pool.fragments.size(), all - 1);
}

TEST(Lying, PeopleKeepAll) {
  const Skeleton skeleton = humanoid();
  FragmentPool pool = cut_with_a_sunk_one(skeleton, gait_clip({}, "walk"), 0.5);
  const std::size_t all = pool.fragments.size();
  drop_lying(pool, 0);
  EXPECT_EQ(pool.fragments.size(), all);
}

}  // namespace
}  // namespace fragmotion

// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "fragments/look.hpp"
#include "fragments/packed_pool.hpp"
#include "small_character.hpp"

namespace fragmotion {
namespace {

TEST(Look, IsOfTheBonesAboveTheArms) {
  const Skeleton skeleton = humanoid();
  const std::vector<int> bones = look_bones(skeleton);
  ASSERT_FALSE(bones.empty());
  EXPECT_EQ(bones.back(), skeleton.roles.head);
  EXPECT_TRUE(skeleton.is_below(skeleton.roles.left_hand, skeleton.parents[bones.front()]));
  for (std::size_t i = 1; i < bones.size(); ++i) EXPECT_EQ(skeleton.parents[bones[i]], bones[i - 1]);
  EXPECT_EQ(look_bones(kneeless_skeleton(true)), std::vector<int>{kneeless_skeleton(true).roles.head});
}

TEST(Look, IsOfTheHeadAloneWhereTheArmsHangFromIt) {
  Skeleton skeleton = humanoid();
  skeleton.roles.head = skeleton.parents[look_bones(skeleton).front()];
  EXPECT_EQ(look_bones(skeleton), std::vector<int>{skeleton.roles.head});
}

TEST(Look, IsOfNoBonesWithoutAHead) {
  Skeleton skeleton = humanoid();
  skeleton.roles.head = -1;
  EXPECT_TRUE(look_bones(skeleton).empty());
  const PackedPool pool = pack(FragmentPool{skeleton, {gait_clip({})}, {Fragment{0, 10, 20}}});
  EXPECT_TRUE(looks_in({&pool}).fastest.empty());
}

TEST(Look, IsAsFastAsTheHeadTurnsInTheWorld) {
  Gait gait;
  gait.turn = 0.7;
  FragmentPool pool{humanoid(), {gait_clip(gait), gait_clip({})}, {Fragment{0, 10, 20}, Fragment{1, 10, 20}}};
  const auto fastest = [&] {
    const PackedPool packed = pack(pool);
    return looks_in({&packed}).fastest;
  };
  for (const float turn : fastest()) EXPECT_NEAR(turn, 0.7, 0.1);
  pool.fragments[0].origin = Origin::transformed;
  for (const float turn : fastest()) EXPECT_LT(turn, 0.2);
}

}  // namespace
}  // namespace fragmotion

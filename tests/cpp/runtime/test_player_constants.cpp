// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <set>

#include "runtime/player_constants.hpp"

namespace fragmotion {
namespace {

TEST(PlayerConstants, AreAtMostThirtyOfDifferentNamesAndPositive) {
  PlayerConstants constants;
  std::set<std::string> names;
  int count = 0;
  for_each_constant(constants, [&](const char* name, double value) {
    EXPECT_GT(value, 0) << name;
    names.insert(name);
    ++count;
  });
  EXPECT_EQ(static_cast<int>(names.size()), count);
  EXPECT_EQ(sizeof(PlayerConstants), count * sizeof(double));
  EXPECT_LE(count, 30);
}

TEST(PlayerConstants, AreAsTheyAreButForThoseThatAreNamed) {
  PlayerConstants changed = player_constants({{"stitch_fades", 3}});
  EXPECT_EQ(changed.stitch.fades, 3);
  EXPECT_EQ(changed.stitch.calms, PlayerConstants{}.stitch.calms);
  EXPECT_THROW(player_constants({{"no_such", 3}}), std::invalid_argument);
  EXPECT_THROW(player_constants({{"stitch_fades", 0}}), std::invalid_argument);
}

}  // namespace
}  // namespace fragmotion

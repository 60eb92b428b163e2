// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <set>

#include "runtime/player.hpp"
#include "small_character.hpp"

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

// What a player shows that is told so of its constants, on stairs.
std::vector<std::vector<double>> shown(const std::map<std::string, double>& changed) {
  PlayerOptions options;
  options.constants = player_constants(changed);
  Player player(gait_character(), options);
  player.stand_on([](const Vector3& from) { return GroundPoint{0.18 * std::floor(from.y() / 0.3), Vector3::UnitZ()}; });
  std::vector<std::vector<double>> rotations;
  for (const Control& control : simulate_trace("explorer", 20, 5, player.character().space)) {
    for (int i = 0; i < 3; ++i) {
      player.step(control, 1.0 / 30);
      rotations.push_back(player.rotations());
    }
  }
  return rotations;
}

TEST(PlayerConstants, ChangeWhatFeetAndLeanShow) {
  PlayerConstants usual;
  const std::vector<std::vector<double>> as_usual = shown({});
  for_each_constant(usual, [&](const std::string& name, double value) {
    if (name.rfind("feet", 0) == 0 || name.rfind("lean", 0) == 0)
      EXPECT_NE(shown({{name, value / 3}}), as_usual) << name;
  });
}

}  // namespace
}  // namespace fragmotion

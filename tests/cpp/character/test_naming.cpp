// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <set>

#include "character/naming.hpp"
#include "small_character.hpp"

namespace fragmotion {
namespace {

std::string named(double x, double y, double turn = 0, double jump = 0) {
  return control_name(ControlSpace(), {x, y, turn, jump});
}

TEST(ControlName, IsAsThePaperNamesClasses) {
  EXPECT_EQ(named(0, 0), "stand");
  EXPECT_EQ(named(0.1, 0, 1), "turn left in place");
  EXPECT_EQ(named(0, 0, -0.8), "turn right in place");
  EXPECT_EQ(named(0, 1.2), "walk forward");
  EXPECT_EQ(named(-0.8, 0.8), "walk forward left");
  EXPECT_EQ(named(0, 1.1, 1), "walk forward turning left");
  EXPECT_EQ(named(0, -1.2), "walk back");
  EXPECT_EQ(named(0.8, -0.8), "walk back right");
  EXPECT_EQ(named(-1.2, 0), "sidestep left");
  EXPECT_EQ(named(1.2, 0, 1), "sidestep right turning left");
  EXPECT_EQ(named(-3.3, 0), "run left");
  EXPECT_EQ(named(0, 3, -1), "run forward turning right");
  EXPECT_EQ(named(0, 0, 0, 1), "jump up");
  EXPECT_EQ(named(0, 0, 1, 1), "jump up turning left");
  EXPECT_EQ(named(0, 1.2, 0, 1), "jump forward");
  EXPECT_EQ(named(0, 3.3, 0, 0.9), "running jump forward");
}

TEST(ControlName, TellsAllPointsApart) {
  const ControlSpace space;
  std::set<std::string> names;
  for (int i = 0; i < kPaperPoints; ++i) names.insert(control_name(space, space.point(i)));
  EXPECT_EQ(names.size(), std::size_t{kPaperPoints});
}

TEST(ClassNames, AreTheRepresentativesAndNumberedWhereTheyRepeat) {
  const auto character = gait_character();
  const std::vector<std::string> names = class_names(*character);
  ASSERT_EQ(static_cast<int>(names.size()), character->classes.count);
  EXPECT_EQ(std::set<std::string>(names.begin(), names.end()).size(), names.size());
  int numbered = 0;
  for (std::size_t k = 0; k < names.size(); ++k) {
    const Fragment& f = character->pool.fragments[character->classes.representatives[k]];
    const std::string name = control_name(character->space, f.evident);
    EXPECT_EQ(names[k].rfind(name, 0), 0U);
    numbered += names[k] != name ? 1 : 0;
  }
  EXPECT_GT(numbered, 0);
}

}  // namespace
}  // namespace fragmotion

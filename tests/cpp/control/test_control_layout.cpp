// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>

#include "base/random.hpp"
#include "character/naming.hpp"
#include "control/gaits.hpp"
#include "control/simulated_players.hpp"

namespace fragmotion {
namespace {

std::vector<ControlSpace> all_spaces() {
  const std::vector<double> speeds{0.7, 1.3, 2.1, 3.6};
  std::vector<ControlSpace> spaces;
  for (int count = 1; count <= kMostSpeeds; ++count) {
    for (const int directions : {4, 8, 16}) {
      for (const bool turn : {false, true}) {
        for (const bool jump : {false, true}) {
          const std::vector<double> some(speeds.end() - count, speeds.end());
          spaces.emplace_back(ControlLayout{count, directions, turn, jump}, some, 1.2, 1.0);
        }
      }
    }
  }
  return spaces;
}

TEST(ControlLayout, IsThePapersUnlessTold) {
  EXPECT_EQ(kPaperPoints, 102);
  EXPECT_EQ(ControlSpace().size(), 102);
  EXPECT_TRUE(ControlSpace().layout() == ControlLayout());
  EXPECT_TRUE((ControlLayout{2, 8, true, false}) != ControlLayout());
}

TEST(ControlLayout, TellsAPointsPartsAndThePointOfThem) {
  for (const ControlSpace& space : all_spaces()) {
    const ControlLayout& layout = space.layout();
    EXPECT_EQ(space.size(), (1 + layout.speeds * layout.directions) * (layout.turn ? 3 : 1) * (layout.jump ? 2 : 1));
    for (int i = 0; i < space.size(); ++i) {
      const Control& point = space.point(i);
      const int velocity = layout.velocity_of(i);
      ASSERT_EQ(layout.index(velocity, layout.turn_of(i), layout.is_jump(i)), i);
      ASSERT_EQ(layout.turn_of(i), point.turn);
      ASSERT_EQ(layout.is_jump(i), point.jumps());
      if (velocity == 0) {
        ASSERT_EQ(point.speed(), 0);
        continue;
      }
      const double angle = 2 * kPi * layout.direction_of(velocity) / layout.directions;
      const double speed = space.speeds()[layout.speed_of(velocity)];
      ASSERT_NEAR(point.x, -speed * std::sin(angle), 1e-12);
      ASSERT_NEAR(point.y, speed * std::cos(angle), 1e-12);
      ASSERT_FALSE(std::signbit(point.x) && point.x == 0) << "which would be written as -0";
    }
  }
}

TEST(ControlLayout, LeavesOutWhatCannotBeAskedFor) {
  const ControlLayout plain{1, 4, false, false};
  EXPECT_EQ(plain.size(), 5);
  for (const int turn : {-1, 0, 1}) {
    for (const bool jump : {false, true}) EXPECT_EQ(plain.index(3, turn, jump), 3);
  }
  const Control asked{1, 2, -0.5, 1};
  const Control admitted = ControlSpace(plain, {1}, 1, 1).admitted(asked), same = ControlSpace().admitted(asked);
  EXPECT_EQ(admitted.turn, 0);
  EXPECT_EQ(admitted.jump, 0);
  EXPECT_EQ(admitted.y, 2);
  EXPECT_EQ(same.turn, -0.5);
  EXPECT_EQ(same.jump, 1);
}

TEST(ControlLayout, HasTheNearestOfAllItsPoints) {
  Random random(5);
  const auto any = [&](double limit) { return limit * (2 * random.uniform() - 1); };
  for (const ControlSpace& space : all_spaces()) {
    for (int n = 0; n < 200; ++n) {
      const Control control{any(5), any(5), any(1.5), 2 * random.uniform() - 0.5};
      int best = 0;
      for (int i = 1; i < space.size(); ++i) {
        if (space.distance(space.point(i), control) < space.distance(space.point(best), control)) best = i;
      }
      ASSERT_NEAR(space.distance(space.point(space.nearest(control)), control),
                  space.distance(space.point(best), control), 1e-12);
    }
    for (int i = 0; i < space.size(); ++i) ASSERT_EQ(space.nearest(space.point(i)), i);
  }
}

TEST(ControlLayout, NamesTheNumberThatNoneMayHave) {
  const auto refused = [](const ControlLayout& layout, std::vector<double> speeds) -> std::string {
    try {
      ControlSpace(layout, std::move(speeds), 1, 1);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_EQ(refused({0, 8}, {}), "control space: number of speeds is 0, expected 1 to 4");
  EXPECT_EQ(refused({5, 8}, {1, 2, 3, 4, 5}), "control space: number of speeds is 5, expected 1 to 4");
  EXPECT_EQ(refused({2, 7}, {1, 2}), "control space: number of directions is 7, expected 4, 8 or 16");
  EXPECT_EQ(refused({3, 8}, {1, 2}), "control space: number of speeds is 2, expected as many as the layout has");
  EXPECT_EQ(refused({3, 8}, {1, 2, 2}), "control space: speed (m/s) is 2, expected more than what is slower");
  EXPECT_EQ(refused({1, 4}, {-1}), "control space: speed (m/s) is -1, expected a number above 0, up to 1e9");
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(refused({3, 4}, {1, nan, 2}).find("speed (m/s) is nan"), std::string::npos);
}

TEST(Matched, IsTheBestOfAllWays) {
  EXPECT_EQ(matched({}, {1, 2}), std::vector<int>());
  EXPECT_EQ(matched({1.1}, {1, 2}), std::vector<int>{0});
  EXPECT_EQ(matched({1.9}, {1, 2}), std::vector<int>{1});
  EXPECT_EQ(matched({1, 1.1}, {1, 2, 4}), (std::vector<int>{0, 1})) << "each has a slot of its own";
  EXPECT_EQ(matched({100, 200}, {1, 2, 4}), (std::vector<int>{1, 2}));
  EXPECT_EQ(matched({1, 2, 3}, {7, 8, 9}), (std::vector<int>{0, 1, 2}));
}

TEST(Gaits, AreAWalkAndARunOrTheNearest) {
  const auto names = [](const std::vector<double>& speeds) {
    std::string text;
    for (const int gait : gaits_of(speeds)) text += std::string(text.empty() ? "" : " ") + kGaits[gait].name;
    return text;
  };
  EXPECT_EQ(names({0.6, 1.1}), "walk run");
  EXPECT_EQ(names({1.3}), "walk");
  EXPECT_EQ(names({3.9}), "run");
  EXPECT_EQ(names({0.7, 1.3, 3.4}), "stroll walk run");
  EXPECT_EQ(names({1.3, 2.1, 3.6}), "walk jog run");
  EXPECT_EQ(names({1.3, 2.1, 3.6, 6}), "walk jog run sprint");
  EXPECT_EQ(ControlSpace({3, 8}, {0.7, 1.3, 3.4}, 1, 1).walk(), 1.3);
  EXPECT_EQ(ControlSpace({3, 8}, {0.07, 0.13, 0.34}, 1, 10).walk(), 0.13) << "of a small body";
  EXPECT_EQ(ControlSpace({1, 8}, {3.4}, 1, 1).walk(), 3.4);
  EXPECT_EQ(ControlSpace({4, 8}, {0.7, 1.3, 2.1, 3.6}, 1, 1).run(), 3.6);
}

TEST(ControlName, TellsAllPointsOfAnySpaceApart) {
  for (const ControlSpace& space : all_spaces()) {
    std::set<std::string> names;
    for (int i = 0; i < space.size(); ++i) names.insert(control_name(space, space.point(i)));
    EXPECT_EQ(static_cast<int>(names.size()), space.size());
  }
  const ControlSpace fine({4, 16}, {0.7, 1.3, 2.1, 3.6}, 1, 1);
  EXPECT_EQ(control_name(fine, {0, 0.7, 0, 0}), "stroll forward");
  EXPECT_EQ(control_name(fine, {-2.1 * std::sin(kPi / 8), 2.1 * std::cos(kPi / 8), 1, 0}),
            "jog forward slightly left turning left");
  EXPECT_EQ(control_name(fine, {1.3, 0, 0, 0}), "sidestep right");
  EXPECT_EQ(control_name(fine, {0.7, 0, 0, 1}), "strolling jump right");
}

// Which of the speeds a player asks for, and whether for turns and jumps.
struct AskedControl {
  std::set<int> speeds;
  bool turn = false, jump = false;
};

AskedControl asked_by(const std::string& player, const ControlSpace& space) {
  AskedControl asked;
  for (const Control& control : simulate_trace(player, 300, 1, space)) {
    const int point = space.nearest(control), velocity = space.layout().velocity_of(point);
    EXPECT_EQ(space.distance(control, space.point(point)), 0);
    if (velocity > 0) asked.speeds.insert(space.layout().speed_of(velocity));
    asked.turn = asked.turn || control.turn != 0;
    asked.jump = asked.jump || control.jump != 0;
  }
  return asked;
}

TEST(SimulateTrace, AsksForAllThatASpaceHas) {
  for (const ControlSpace& space : all_spaces()) {
    const AskedControl asked = asked_by("explorer", space);
    EXPECT_EQ(static_cast<int>(asked.speeds.size()), space.layout().speeds);
    EXPECT_EQ(asked.turn, space.layout().turn);
    EXPECT_EQ(asked.jump, space.layout().jump);
  }
  const ControlSpace four({4, 8}, {0.7, 1.3, 2.1, 3.6}, 1, 1);
  EXPECT_EQ(*asked_by("stroller", four).speeds.rbegin(), 1) << "who never runs";
}

}  // namespace
}  // namespace fragmotion

// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "base/random.hpp"
#include "build/find_controls.hpp"

namespace fragmotion {
namespace {

// So many fragments at each of the speeds (m/s), straight on in so many directions.
std::vector<Control> going(const std::vector<double>& speeds, int directions, int each = 40) {
  Random random(1);
  std::vector<Control> evident;
  for (const double speed : speeds) {
    for (int i = 0; i < each * directions; ++i) {
      const double angle = 2 * kPi * (i % directions) / directions, v = speed * (0.96 + 0.08 * random.uniform());
      evident.push_back({-v * std::sin(angle), v * std::cos(angle), 0, 0});
    }
  }
  return evident;
}

void expect_speeds(const ControlSpace& space, const std::vector<double>& wanted, double within = 0.02) {
  ASSERT_EQ(space.speeds().size(), wanted.size());
  for (std::size_t i = 0; i < wanted.size(); ++i) EXPECT_NEAR(space.speeds()[i], wanted[i], within * wanted[i]) << i;
}

ControlOptions told(int speeds, int directions = 8) { return {false, {speeds, directions, true, true}}; }
constexpr ControlOptions kFound{true, {}};

TEST(ControlSpaceOf, HasAsManySpeedsAsItIsTold) {
  const std::vector<double> speeds{0.7, 1.3, 2.2, 3.8};
  for (const double size : {1.0, 10.0}) {
    std::vector<Control> evident = going(speeds, 4), three = going({0.7, 1.3, 3.8}, 4);
    for (std::vector<Control>* some : {&evident, &three}) {
      for (Control& c : *some) c.x *= size, c.y *= size;
    }
    expect_speeds(control_space_of(evident, 1 / size, told(4)), {0.7 * size, 1.3 * size, 2.2 * size, 3.8 * size});
    expect_speeds(control_space_of(three, 1 / size, told(3)), {0.7 * size, 1.3 * size, 3.8 * size});
  }
  const ControlSpace space = control_space_of(going(speeds, 4), 1, {false, {3, 16, false, true}});
  EXPECT_TRUE((space.layout() == ControlLayout{3, 16, false, true}));
}

TEST(ControlSpaceOf, HasOfOneSpeedThatOfMost) {
  std::vector<Control> evident = going({1.3}, 4, 30);
  const std::vector<Control> runs = going({3.5}, 4, 10);
  evident.insert(evident.end(), runs.begin(), runs.end());
  expect_speeds(control_space_of(evident, 1, told(1)), {1.3});
}

TEST(ControlSpaceOf, FillsUpWithWhatPeopleGoAt) {
  const ControlSpace walks = control_space_of(going({1.4}, 1), 1, told(3));
  expect_speeds(walks, {1.4, 2.2, 3.3});
  EXPECT_EQ(held_controls(going({1.4}, 1), walks).speeds, 1);
  expect_speeds(control_space_of(going({1.4, 3.0}, 1), 1, told(4)), {0.7, 1.4, 2.2, 3.0});
  expect_speeds(control_space_of(going({9}, 1), 1, told(2)), {9 / 2.75, 9});
}

TEST(ControlSpaceOf, TakesNoShuffleForAWalk) {
  expect_speeds(control_space_of(going({0.4, 1.4}, 4), 1, {}), {1.4, 1.4 * 3.3 / 1.2});
  expect_speeds(control_space_of(going({0.4, 3.5}, 4), 1, {}), {3.5 * 1.2 / 3.3, 3.5});
}

TEST(ControlSpaceOf, TakesASlowWalkOfAGiantForOne) {
  std::vector<Control> evident = going({0.4, 3.5}, 4);
  for (Control& c : evident) c.x *= 7, c.y *= 7;
  expect_speeds(control_space_of(evident, 1 / 7.0, {}), {0.4 * 7, 3.5 * 7});
}

// A pack's walk and sprint may be 1.5 apart.
TEST(ControlSpaceOf, TellsGaitsOfWhichNothingGoesBetweenThem) {
  expect_speeds(control_space_of(going({1.2, 1.8}, 4), 1, {}), {1.2, 1.8});
  expect_speeds(control_space_of(going({1.2, 1.3, 1.4, 1.5, 1.6, 1.7, 1.8}, 4), 1, {}), {1.5, 1.5 * 3.3 / 1.2});
  std::vector<Control> strays = going({1.2}, 4);
  for (int i = 0; i < 3; ++i) strays.push_back({0, 1.8, 0, 0});
  expect_speeds(control_space_of(strays, 1, {}), {1.2, 1.2 * 3.3 / 1.2});
}

TEST(ControlSpaceOf, HasTheSpeedsOfWhatGoesStraightAhead) {
  std::vector<Control> evident = going({1.2, 4}, 1);
  for (const Control& ev : going({0.9, 3}, 1)) {
    evident.push_back({0, -ev.y, 0, 0});
    evident.push_back({ev.y, 0, 0, 0});
    evident.push_back({0, ev.y, 1, 0});
  }
  expect_speeds(control_space_of(evident, 1), {1.2, 4});
}

TEST(ControlSpaceOf, HasNoSpeedOfAFewStrayFragments) {
  std::vector<Control> evident = going({1.3}, 8, 40);
  evident.push_back({0, 5, 0, 0});
  evident.push_back({0, 5.1, 0, 0});
  EXPECT_EQ(control_space_of(evident, 1, kFound).speeds().size(), 1U);
}

TEST(ControlSpaceOf, FindsWhatTheTakesHold) {
  struct Case {
    std::vector<double> speeds;
    int directions, found;
  };
  for (const auto& [speeds, directions, found] :
       {Case{{1.3}, 1, 4}, Case{{1.3}, 4, 4}, Case{{0.7, 1.3, 3.5}, 8, 8}, Case{{0.7, 1.3, 2.2, 3.8}, 16, 16}}) {
    const ControlSpace space = control_space_of(going(speeds, directions), 1, kFound);
    expect_speeds(space, speeds);
    EXPECT_EQ(space.layout().directions, found);
    EXPECT_FALSE(space.layout().turn);
    EXPECT_FALSE(space.layout().jump);
  }
  std::vector<Control> all = going({1.3, 3.5}, 8);
  for (int i = 0; i < 40; ++i) all.push_back({0, 1.3, 1, 0}), all.push_back({0, 0, 0, 1});
  EXPECT_TRUE(control_space_of(all, 1, kFound).layout() == ControlLayout());
  expect_speeds(control_space_of(all, 1, kFound), control_space_of(all, 1).speeds(), 1e-12);
}

TEST(ControlSpaceOf, IsASpaceForAnyFragmentsAndOptions) {
  Random random(2);
  for (int n = 0; n < 600; ++n) {
    std::vector<Control> evident(random.below(60));
    const double size = 10 * random.uniform() * random.uniform();
    for (Control& c : evident) {
      c = {size * (random.uniform() - 0.5), size * (random.uniform() - 0.5), 3 * random.uniform() - 1.5,
           random.uniform()};
    }
    const ControlOptions options{n % 5 == 0, {1 + n % 4, n % 3 == 0 ? 4 : n % 3 == 1 ? 8 : 16, n % 2 == 0, n % 7 == 0}};
    const ControlSpace space = control_space_of(evident, 1, options);
    if (!options.find) EXPECT_TRUE(space.layout() == options.layout);
    const HeldControls held = held_controls(evident, space);
    EXPECT_LE(held.speeds, space.layout().speeds);
    EXPECT_LE(held.directions, space.layout().directions);
  }
  EXPECT_EQ(control_space_of({}, 1, kFound).layout().speeds, 2) << "as people go";
}

TEST(UsualSpace, IsAsPeopleGo) {
  expect_speeds(usual_space(told(4, 16)), {0.7, 1.2, 2.2, 3.3}, 1e-12);
  EXPECT_EQ(usual_space(told(4, 16)).size(), 390);
  EXPECT_EQ(usual_space({}).speeds(), ControlSpace().speeds());
  EXPECT_EQ(usual_space(kFound).size(), kPaperPoints);
}

TEST(ControlSpaceOf, RefusesALayoutThatThereIsNone) {
  EXPECT_THROW(control_space_of({}, 1, told(5)), std::invalid_argument);
  EXPECT_THROW(control_space_of({}, 1, told(2, 6)), std::invalid_argument);
}

TEST(HeldControls, CountsWhatThereIsEnoughOf) {
  const ControlSpace space({2, 16}, {1.3, 3.5}, 1.2, 1);
  std::vector<Control> evident = going({1.3}, 4);
  EXPECT_EQ(held_controls(evident, space).speeds, 1);
  EXPECT_EQ(held_controls(evident, space).directions, 4);
  EXPECT_FALSE(held_controls(evident, space).turn || held_controls(evident, space).jump);
  for (int i = 0; i < 2; ++i) evident.push_back({0, 3.5, 1, 1});
  EXPECT_FALSE(held_controls(evident, space).turn || held_controls(evident, space).jump) << "two are too few";
  for (int i = 0; i < 2; ++i) evident.push_back({0, 3.5, 1, 1}), evident.push_back({0, 3.5, 0, 0});
  EXPECT_TRUE(held_controls(evident, space).turn && held_controls(evident, space).jump);
  EXPECT_EQ(held_controls({}, space).speeds, 0);
}

TEST(ControlSpaceOf, FindsTwoGaits) {
  Random random(1);
  std::vector<Control> evident;
  for (int i = 0; i < 200; ++i) {
    const double angle = 2 * kPi * random.uniform(), speed = i % 2 == 0 ? 1.4 : 4.2;
    evident.push_back({speed * std::cos(angle), speed * std::sin(angle), 0, 0});
  }
  for (const double size : {1.0, 10.0}) {
    std::vector<Control> sized = evident;
    for (Control& c : sized) c.x *= size, c.y *= size;
    const ControlSpace space = control_space_of(sized, 1 / size);
    EXPECT_NEAR(space.walk(), 1.4 * size, 1e-9 * size);
    EXPECT_NEAR(space.run(), 4.2 * size, 1e-9 * size);
    EXPECT_NEAR(space.scale(), 1 / size, 1e-12);
  }
}

TEST(ControlSpaceOf, KeepsTheDefaultsWhereNothingMoves) {
  const ControlSpace standard, space = control_space_of(std::vector<Control>(20), 1);
  EXPECT_NEAR(space.walk(), standard.walk(), 1e-12);
  EXPECT_NEAR(space.run(), standard.run(), 1e-12);
  EXPECT_NEAR(space.turn_rate(), standard.turn_rate(), 1e-12);
}

TEST(ControlSpaceOf, IsASpaceForAnyFragments) {
  Random random(2);
  for (int n = 0; n < 300; ++n) {
    std::vector<Control> evident(1 + random.below(30));
    const double size = 10 * random.uniform() * random.uniform();
    for (Control& c : evident)
      c = {size * (random.uniform() - 0.5), size * (random.uniform() - 0.5), 3 * random.uniform() - 1.5,
           random.uniform()};
    const ControlSpace space = control_space_of(evident, 1);
    EXPECT_GT(space.walk(), 0);
    EXPECT_GT(space.run(), space.walk());
    EXPECT_GT(space.turn_rate(), 0);
  }
}

}  // namespace
}  // namespace fragmotion

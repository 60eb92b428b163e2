// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <limits>

#include "mocap_files.hpp"
#include "runtime/step_on_threads.hpp"
#include "small_character.hpp"
#include "steering.hpp"

namespace fragmotion {
namespace {

constexpr int kCount = 37, kSteps = 200;

Control any_control(Random& random) {
  return {4 * random.uniform() - 2, 4 * random.uniform() - 2, 2 * random.uniform() - 1, random.uniform()};
}

std::vector<Control> any_controls(Random& random) {
  std::vector<Control> controls;
  for (int i = 0; i < kCount; ++i) controls.push_back(any_control(random));
  return controls;
}

// What a crowd shows at last that stands in so many parts, each with a thread: roots, then rotations.
std::vector<double> shown_at_last(int parts) {
  Crowd crowd(gait_character(), kCount, {5}, parts);
  Random random(7);
  std::vector<double> roots(3 * kCount), rotations(4 * kCount * std::size_t(crowd.bones()));
  for (int i = 0; i < kSteps; ++i) {
    if (i == 50) crowd.force(3, 2);
    if (i == 70) crowd.reset(4, {{1, 2}, 3});
    step_on_threads(crowd, any_controls(random).data(), kStep, roots.data(), rotations.data());
  }
  roots.insert(roots.end(), rotations.begin(), rotations.end());
  return roots;
}

TEST(Crowd, ShowsTheSameBitsWhateverTheThreads) {
  const std::vector<double> expected = shown_at_last(1);
  for (const int parts : {2, 3, 64}) EXPECT_EQ(shown_at_last(parts), expected) << parts;
}

TEST(Crowd, ShowsWhatPlayersShowThatAreSteppedAlone) {
  const std::vector<double> shown = shown_at_last(2);
  const std::size_t width = std::size_t{4} * gait_character()->pool.skeleton.size();
  for (int player = 0; player < kCount; ++player) {
    Player alone(gait_character(), {std::uint64_t(5 + player)});
    Random random(7);
    for (int i = 0; i < kSteps; ++i) {
      if (i == 50 && player == 3) alone.force(2);
      if (i == 70 && player == 4) alone.reset({{1, 2}, 3});
      alone.step(any_controls(random)[player], kStep);
    }
    ASSERT_EQ(alone.root_position(), load_vector(&shown[3 * player])) << player;
    for (std::size_t k = 0; k < width; ++k) ASSERT_EQ(alone.rotations()[k], shown[3 * kCount + width * player + k]);
  }
}

TEST(Crowd, MovesNobodyWhereOneControlIsRefused) {
  Crowd crowd(gait_character(), kCount, {}, 2);
  std::vector<double> before(3 * kCount), after = before;
  std::vector<Control> controls(kCount, Control{0, 1.2, 0, 0});
  for (int i = 0; i < 30; ++i) crowd.step(controls.data(), kStep, before.data());
  controls.back().turn = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(error_of([&] { crowd.step(controls.data(), kStep); }).find("not a number"), std::string::npos);
  EXPECT_NE(error_of([&] { step_on_threads(crowd, controls.data(), kStep); }).find("not a number"), std::string::npos);
  controls.back().turn = 0;
  EXPECT_NE(error_of([&] { crowd.step(controls.data(), -1); }).find("step"), std::string::npos);
  crowd.step(controls.data(), 0, after.data());
  EXPECT_EQ(after, before);
}

TEST(Crowd, MayBeEmptyButNotLess) {
  Crowd none(gait_character(), 0);
  EXPECT_EQ(none.size(), 0);
  EXPECT_NO_THROW(none.step(nullptr, kStep));
  EXPECT_NE(error_of([] { Crowd(gait_character(), -1); }).find("crowd"), std::string::npos);
  EXPECT_NE(error_of([] { Crowd(gait_character(), kMostPlayers + 1); }).find("100000"), std::string::npos);
  PlayerOptions options;
  options.root_adjustment = 2;
  EXPECT_NE(error_of([&] { Crowd(gait_character(), 2, options); }).find("root adjustment"), std::string::npos);
}

TEST(Crowd, HasNoPlayersAndPartsButItsOwn) {
  Crowd crowd(gait_character(), kCount, {}, 2);
  const std::vector<Control> controls(kCount);
  for (const int out : {-1, kCount}) {
    EXPECT_NE(error_of([&] { crowd[out]; }).find("player " + std::to_string(out)), std::string::npos);
  }
  for (const int out : {-1, 2}) {
    EXPECT_NE(error_of([&] { crowd.step_part(out, controls.data(), kStep); }).find("part " + std::to_string(out)),
              std::string::npos);
  }
}

}  // namespace
}  // namespace fragmotion

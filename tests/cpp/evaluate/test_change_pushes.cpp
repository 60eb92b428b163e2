// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "evaluate/change_pushes.hpp"
#include "small_character.hpp"

namespace fragmotion {
namespace {

TEST(Changes, AreOfTheseKinds) {
  const Control stand, walk{0, 1.2, 0, 0}, run{0, 3, 0, 0}, left{-1.2, 0, 0, 0}, back{0, -3, 0, 0};
  const Control back_left{-1.2, -1.2, 0, 0}, curve{0, 1.2, 1, 0};
  EXPECT_EQ(kind_of(stand, run), Change::start);
  EXPECT_EQ(kind_of(walk, stand), Change::stop);
  EXPECT_EQ(kind_of(walk, back), Change::reverse);
  EXPECT_EQ(kind_of(walk, back_left), Change::reverse);
  EXPECT_EQ(kind_of(run, left), Change::turn);
  EXPECT_EQ(kind_of(walk, curve), Change::turn);
  EXPECT_EQ(kind_of(run, walk), Change::gait);
}

TEST(ChangePushes, AreHarderWhereTheCommandIsFollowedAtOnce) {
  const auto character = gait_character();
  PlayerOptions at_once;
  at_once.responsiveness = 1;
  const auto gentle = change_pushes(character), hard = change_pushes(character, at_once);
  const auto reverse = static_cast<std::size_t>(Change::reverse), gait = static_cast<std::size_t>(Change::gait);
  for (std::size_t kind = 0; kind < gentle.size(); ++kind) {
    EXPECT_GT(gentle[kind].worst, 0);
    EXPECT_LE(gentle[kind].p50, gentle[kind].p99);
    // Between gaits that go the same way less changes than steps push.
    if (kind != gait) EXPECT_LT(gentle[kind].p99, hard[kind].p99) << kind;
  }
  EXPECT_GT(hard[reverse].p99, hard[gait].p99);
  PlayerOptions carried;
  carried.lock_feet = false;
  const auto start = static_cast<std::size_t>(Change::start);
  EXPECT_LT(gentle[start].dragged, change_pushes(character, carried)[start].dragged);
}

}  // namespace
}  // namespace fragmotion

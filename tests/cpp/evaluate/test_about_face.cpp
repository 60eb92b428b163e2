// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>

#include "evaluate/about_face.hpp"
#include "small_character.hpp"

namespace fragmotion {
namespace {

TEST(AboutFaceTimes, TakeAboutAsLongAsTheTurnRateAllows) {
  const auto character = gait_character();
  const std::vector<double> times = about_face_times(character);
  EXPECT_EQ(times.size(), 16u);
  const double quickest = character->space.quickest_turn() * character->space.turn_rate();
  for (const double time : times) {
    EXPECT_GT(time, (kPi - 0.3) / (1.3 * quickest));
    EXPECT_LT(time, kPi / quickest + 1);
  }
  EXPECT_EQ(times, about_face_times(character));
}

TEST(AboutFaceTimes, TellThatACharacterCannotTurn) {
  PlayerOptions plain;
  plain.root_adjustment = 0;
  const std::vector<double> times = about_face_times(std::make_shared<const Character>(tiny_character()), plain);
  EXPECT_EQ(*std::min_element(times.begin(), times.end()), kNoAboutFace);
}

}  // namespace
}  // namespace fragmotion

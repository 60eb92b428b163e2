// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

#include "motion/cycle.hpp"
#include "motion/marker.hpp"
#include "small_character.hpp"

namespace fragmotion {
namespace {

using Frames = std::vector<double>;

Frames frames_of(const std::vector<Marker>& markers) {
  Frames frames;
  for (const Marker& marker : markers) frames.push_back(marker.frame);
  return frames;
}

TEST(Markers, AreNamedWithinTheTakeAndInOrder) {
  EXPECT_NO_THROW(check_markers({{"a", 0}, {"b", 3.5}, {"b", 9}}, 10));
  const double none = std::numeric_limits<double>::quiet_NaN();
  for (const auto& wrong : {Marker{"", 3}, Marker{"a", -0.1}, Marker{"a", 9.1}, Marker{"a", none}}) {
    EXPECT_THROW(check_markers({wrong}, 10), std::invalid_argument) << wrong.frame;
  }
  EXPECT_THROW(check_markers({{"a", 4}, {"b", 3}}, 10), std::invalid_argument);
}

TEST(Markers, OfWhatIsShownAgainAndAgainAreInEachRound) {
  const std::vector<Marker> markers{{"before", 2}, {"a", 5}, {"b", 7.5}, {"after", 9}};
  EXPECT_EQ(frames_of(markers_in_rounds(markers, 5, 4, 11)), (Frames{0, 2.5, 4, 6.5, 8}));
  EXPECT_EQ(frames_of(markers_in_rounds(markers, 0, 10, 10)), (Frames{2, 5, 7.5, 9}));
}

TEST(Markers, GoAlongWithAPartOfAClip) {
  Clip clip = gait_clip({}, "walk");
  clip.markers = {{"a", 3}, {"b", 8}, {"c", 20}};
  const Clip middle = part(clip, 5, 20);
  EXPECT_EQ(frames_of(middle.markers), (Frames{3, 15}));
  EXPECT_EQ(middle.markers[0].name, "b");
}

}  // namespace
}  // namespace fragmotion

// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "fragmotion/evaluate/support.hpp"
#include "made_track.hpp"

namespace fragmotion {
namespace {

void lift(BodyTrack& track) {
  for (int side = 0; side < 2; ++side) track.stands[side].assign(track.stands[side].size(), false);
}

TEST(Support, BearsABodyThatStands) {
  const Support support = find_support(standing_track(1));
  EXPECT_EQ(support.judged, 61 - 16);
  EXPECT_EQ(support.unsupported, 0);
}

TEST(Support, BearsAnInvertedPendulumThatFallsFromItsFoot) {
  // x'' = g x / h about the right foot: its zero-moment point is there throughout.
  BodyTrack track = standing_track(1);
  track.stands[0].assign(track.stands[0].size(), false);
  const double w = std::sqrt(kGravity / 0.95);
  move(track, false, [&](double t) { return Vector3(0.1 + 0.05 * std::cosh(w * t), 0, 0); });
  EXPECT_GT(track.center.back().x(), 0.5);
  EXPECT_EQ(find_support(track).unsupported, 0);
}

TEST(Support, BearsNoSlide) {
  // Its zero-moment point is a h / g behind the centre: 0.58 m at 6 m/s^2, 0.15 m at 1.5.
  for (const double acceleration : {6.0, 1.5}) {
    BodyTrack track = standing_track(0.5);
    move(track, true, [&](double t) { return Vector3(0, 0.5 * acceleration * t * t, 0); });
    const Support support = find_support(track);
    EXPECT_GT(support.judged, 10);
    EXPECT_EQ(support.unsupported, acceleration > 2 ? support.judged : 0);
  }
}

TEST(Support, MeasuresFromTheHullOfTheFeet) {
  // To the side, 0.1 m and a foot's length are as far as the zero-moment point gets: a = (0.1 + 0.27) g / 0.95.
  const double most = (0.1 + 0.27) * kGravity / 0.95;
  for (const double share : {0.98, 1.02}) {
    BodyTrack track = standing_track(16 / 60.0);  // whose middle frame alone is judged
    move(track, false, [&](double t) {
      const double from_middle = t - 8 / 60.0;
      return Vector3(0.5 * share * most * from_middle * from_middle, 0, 0);
    });
    const Support support = find_support(track);
    EXPECT_EQ(support.judged, 1);
    EXPECT_EQ(support.unsupported, share > 1 ? 1 : 0) << share;
  }
}

TEST(Support, LetsABodyInTheAirFallAndNothingElse) {
  BodyTrack falls = standing_track(0.6), hovers = falls, drifts = falls;
  for (BodyTrack* track : {&falls, &hovers, &drifts}) lift(*track);
  const auto flight = [](double t) { return Vector3(2 * t, 0, 0.1 + 3 * t - 0.5 * kGravity * t * t); };
  move(falls, true, flight);
  move(hovers, true, [](double t) { return Vector3(2 * t, 0, 0.3); });
  move(drifts, true, [&](double t) { return Vector3(flight(t) + Vector3(0, 2.5 * t * t, 0)); });
  EXPECT_EQ(find_support(falls).unsupported, 0);
  for (const BodyTrack& track : {hovers, drifts}) {
    const Support support = find_support(track);
    EXPECT_EQ(support.unsupported, support.judged);
    EXPECT_EQ(support.unsupported_share(), 1);
  }
}

TEST(Support, TakesFeetNearTheGroundForStandingWhereNoneDoes) {
  BodyTrack track = standing_track(0.5);
  lift(track);
  EXPECT_EQ(find_support(track).unsupported, 0);
}

TEST(Support, CannotPullDown) {
  BodyTrack track = standing_track(0.3);
  move(track, false, [](double t) { return Vector3(0, 0, -7 * t * t); });
  EXPECT_EQ(find_support(track).unsupported, find_support(track).judged);
}

TEST(Support, IsUnknownWithoutFeet) {
  BodyTrack track = standing_track(1);
  track.feet = {};
  track.stands = {};
  EXPECT_TRUE(std::isnan(find_support(track).unsupported_share()));
}

}  // namespace
}  // namespace fragmotion

// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "evaluate/jumps.hpp"
#include "made_track.hpp"

namespace fragmotion {
namespace {

constexpr double kTakeOff = 1, kUp = 3;         // s, m/s
constexpr double kFlight = 2 * kUp / kGravity;  // s
const UsualHeights kUsual{0.95, 0.95};

// A smooth dip of `depth` from `begin` to `end`.
double dip(double t, double begin, double end, double depth) {
  const double at = (t - begin) / (end - begin);
  return at > 0 && at < 1 ? -depth * std::sin(kPi * at) * std::sin(kPi * at) : 0;
}

// Dips by `before`, flies, its time stretched by `slow`, and dips by `after`.
BodyTrack jumping(double before, double after, double slow = 1) {
  BodyTrack track = standing_track(3);
  const double landing = kTakeOff + slow * kFlight;
  for (int f = 0; f < track.frames(); ++f) {
    const double t = f / track.rate, in = (t - kTakeOff) / slow;
    const double air = t > kTakeOff && t < landing ? kUp * in - 0.5 * kGravity * in * in : 0;
    const double bent = dip(t, kTakeOff - 0.4, kTakeOff, before) + dip(t, landing, landing + 0.4, after);
    track.center[f].z() += air + bent;
    track.hips[f].z() += air + bent;
    for (FootPath& foot : track.feet) {
      foot.ball[f].z() += air;
      foot.heel[f].z() += air;
    }
  }
  return track;
}

TEST(Jumps, AreFoundWithTheirDips) {
  const std::vector<Jump> jumps = find_jumps(jumping(0.3, 0.2), kUsual);
  ASSERT_EQ(jumps.size(), 1u);
  EXPECT_NEAR(jumps[0].take_off / 60.0, kTakeOff, 0.04);
  EXPECT_NEAR(jumps[0].landing / 60.0, kTakeOff + kFlight, 0.04);
  EXPECT_NEAR(jumps[0].dip, 0.3, 0.003);
  EXPECT_NEAR(jumps[0].landing_dip, 0.2, 0.003);
  EXPECT_NEAR(jumps[0].flight_ratio, 1, 0.02);
}

TEST(Jumps, MayHaveNoDipAndHang) {
  const std::vector<Jump> jumps = find_jumps(jumping(0, 0, 1.5), kUsual);
  ASSERT_EQ(jumps.size(), 1u);
  EXPECT_EQ(jumps[0].dip, 0);
  EXPECT_EQ(jumps[0].landing_dip, 0);
  EXPECT_NEAR(jumps[0].flight_ratio, 1.5, 0.03);
}

TEST(Jumps, AreNoRunsNorStands) {
  EXPECT_TRUE(find_jumps(standing_track(2), kUsual).empty());
  BodyTrack runs = standing_track(2);
  move(runs, true, [](double t) { return Vector3(0, 0, 0.1 * std::abs(std::sin(5 * t))); });
  EXPECT_TRUE(find_jumps(runs, kUsual).empty());
  BodyTrack legless = jumping(0.3, 0.2);
  legless.feet = {};
  EXPECT_TRUE(find_jumps(legless, kUsual).empty());
}

TEST(Jumps, HaveNoDipThatTheMotionDoesNotShow) {
  BodyTrack track = jumping(0.3, 0.2);
  const int begin = 40;
  track.center.erase(track.center.begin(), track.center.begin() + begin);
  track.hips.erase(track.hips.begin(), track.hips.begin() + begin);
  for (FootPath& foot : track.feet) {
    foot.ball.erase(foot.ball.begin(), foot.ball.begin() + begin);
    foot.heel.erase(foot.heel.begin(), foot.heel.begin() + begin);
  }
  const std::vector<Jump> jumps = find_jumps(track, kUsual);
  ASSERT_EQ(jumps.size(), 1u);
  EXPECT_TRUE(std::isnan(jumps[0].dip));
  EXPECT_NEAR(jumps[0].landing_dip, 0.2, 0.003);
}

TEST(Jumps, AreMeasuredFromMediansOfAllTakes) {
  BodyTrack high = standing_track(1);
  move(high, true, [](double) { return Vector3(0, 0, 1); });
  const UsualHeights usual = usual_heights({standing_track(3), high});
  EXPECT_EQ(usual.center, 0.95);
  EXPECT_EQ(usual.hips, 0.95);
}

}  // namespace
}  // namespace fragmotion

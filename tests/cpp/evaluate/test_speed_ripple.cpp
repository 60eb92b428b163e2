// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "evaluate/speed_ripple.hpp"
#include "evaluate/tracks.hpp"
#include "made_track.hpp"
#include "small_character.hpp"

namespace fragmotion {
namespace {

TEST(Goings, TellTheSpeedAndTheStandardDeviationsOfItAndOfTheHipsHeight) {
  // A bob of 0.04 m / sqrt(2), and speed 1.5 + 0.3 sin(2 pi t / 0.25) m/s: four ripples a second, which a mean over 0.1
  // s makes smaller.
  const double w = 2 * kPi / 0.25, smoothed = std::sin(w * 0.05) / (w * 0.05);
  BodyTrack track = standing_track(4);
  move(track, true, [&](double t) { return Vector3(0, 1.5 * t - 0.3 / w * std::cos(w * t), 0.04 * std::sin(w * t)); });
  const std::vector<Going> found = goings(track);
  ASSERT_EQ(found.size(), 241u - 60u);
  EXPECT_EQ(goings(track, 100).size(), 81u);
  for (const Going& going : found) {
    EXPECT_NEAR(going.speed, 1.5, 1e-9);
    EXPECT_NEAR(going.ripple, 0.3 * smoothed / std::sqrt(2), 0.015);
    EXPECT_NEAR(going.bob, 0.04 / std::sqrt(2), 0.001);
  }
}

TEST(Goings, CountTheFeetThatComeToStand) {
  BodyTrack track = standing_track(4);
  for (int f = 0; f < track.frames(); ++f) {
    track.stands[0][f] = f % 30 < 20;
    track.stands[1][f] = true;
  }
  for (const Going& going : goings(track)) EXPECT_EQ(going.steps, 2);
}

TEST(SteadyGoings, AreForwardAndEven) {
  const auto going = [](const Vector3& velocity, double acceleration) {
    BodyTrack track = standing_track(4);
    move(track, true, [&](double t) { return Vector3(velocity * t + Vector3(0, 0.5 * acceleration * t * t, 0)); });
    return steady_goings(track, {0.95, 0.95}).size();
  };
  EXPECT_EQ(going({0, 1, 0}, 0), 241u - 90u);
  EXPECT_EQ(going({0.4, 1, 0}, 0), 241u - 90u);
  EXPECT_EQ(going({0.8, 1, 0}, 0), 0u);
  EXPECT_EQ(going({0, -1, 0}, 0), 0u);
  EXPECT_EQ(going({0, 1, 0}, 1), 0u);
  EXPECT_TRUE(goings(standing_track(0.5)).empty());
}

// A run with feet off the ground and the hips 0.1 m up, and a leap of 0.3 m, both for the third second of five.
TEST(SteadyGoings, AreNoJumps) {
  const auto found = [](double up) {
    BodyTrack track = standing_track(5);
    move(track, true, [&](double t) { return Vector3(0, t, t > 2 && t < 3 ? up * std::sin(kPi * (t - 2)) : 0); });
    return steady_goings(track, {0.95, 0.95});
  };
  EXPECT_EQ(found(0.1).size(), 301u - 90u);
  const std::vector<Going> walks = found(0.3);
  EXPECT_NEAR(walks.size(), 301 - 90 - 180, 6);  // from 0.5 s to 3.5 s; the ends of the leap are close to the ground
  for (const Going& going : walks) EXPECT_LT(going.bob, 1e-9);
}

std::vector<Going> steady_takes(const Character& character) {
  std::vector<Going> takes;
  const auto tracks = tracks_of(character.pool.skeleton, captured_takes(character.pool)).tracks;
  for (const BodyTrack& track : tracks) {
    for (const Going& going : steady_goings(track, usual_heights(tracks))) takes.push_back(going);
  }
  return takes;
}

TEST(SpeedRipples, AreOfASpeedEachBesideTheTakes) {
  const std::vector<Going> takes = steady_takes(*gait_character());
  const std::vector<SpeedRipple> rows = speed_ripples(gait_character());
  ASSERT_EQ(rows.size(), 6u);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const SpeedRipple& row = rows[i];
    EXPECT_NEAR(row.commanded, 0.5 * static_cast<double>(i + 1), 1e-9);
    EXPECT_GT(row.speed, 0);
    EXPECT_GE(row.ripple, 0);
    EXPECT_GT(row.bob, 0);
    double ripple = 0, bob = 0, steps = 0, count = 0;
    for (const Going& going : takes) {
      EXPECT_GE(std::abs(going.speed - row.commanded), std::abs(row.takes_speed - row.commanded) - 1e-12);
      if (std::abs(going.speed - row.takes_speed) > 0.1) continue;
      ripple += going.ripple;
      bob += going.bob;
      steps += going.steps;
      ++count;
    }
    EXPECT_NEAR(row.takes_ripple, ripple / count, 1e-9);
    EXPECT_NEAR(row.takes_bob, bob / count, 1e-9);
    EXPECT_NEAR(row.takes_steps, steps / count, 1e-9);
    EXPECT_GT(row.steps, 0.5);
  }
  EXPECT_NEAR(rows[1].speed, 1, 0.15);
}

TEST(SpeedRipples, HaveNothingToCompareWhereNoTakeGoes) {
  const auto stands = std::make_shared<const Character>(tiny_character());
  for (const SpeedRipple& row : speed_ripples(stands)) {
    EXPECT_TRUE(std::isnan(row.takes_ripple) && std::isnan(row.takes_bob) && std::isnan(row.takes_steps));
    EXPECT_FALSE(std::isnan(row.ripple));
  }
}

}  // namespace
}  // namespace fragmotion

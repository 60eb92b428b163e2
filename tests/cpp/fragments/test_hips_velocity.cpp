// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "fragments/hips_velocity.hpp"
#include "fragments/packed_pool.hpp"
#include "walker.hpp"

namespace fragmotion {
namespace {

// The frames `begin` .. `end` of a take as the only fragment.
PackedPool one_fragment(Clip clip, int begin, int end) {
  Fragment fragment;
  fragment.begin = begin;
  fragment.end = end;
  return pack(FragmentPool{humanoid(), {std::move(clip)}, {fragment}});
}

// A take that goes backward and gets slower from frame to frame, from 3 m/s by 2 m/s a second.
Clip braking_clip() {
  Gait gait;
  gait.seconds = 1;
  Clip clip = gait_clip(gait);
  for (int f = 0; f < clip.frames; ++f) {
    const double t = f / clip.rate;
    clip.root_positions[3 * static_cast<std::size_t>(f) + 1] = -(3 * t - t * t);
  }
  return make_clip(humanoid(), std::move(clip));
}

TEST(HipsVelocity, IsThatOfTheWayInTheCharacterFrameHalfway) {
  for (const double heading : {0.0, 1.0, -2.5}) {
    Gait gait;
    gait.x = 0.3;
    gait.heading = heading;
    const PackedPool pool = one_fragment(gait_clip(gait), 10, 40);
    const Vector2 velocity = hips_velocity(pool.clips[0], pool.fragments[0]);
    EXPECT_NEAR(velocity.x(), 0.3, 0.02);
    EXPECT_NEAR(velocity.y(), 1.2, 0.02);
  }
}

TEST(HipsVelocity, FollowsABodyThatBrakesButHardlyItsSteps) {
  const PackedPool braking = one_fragment(braking_clip(), 6, 24), walking = one_fragment(gait_clip({}), 10, 40);
  const double rate = braking.clips[0].rate;
  for (int f = 6; f <= 24; ++f) {
    EXPECT_NEAR(hips_velocity_around(braking.clips[0], f, 0.4).y(), 2 * f / rate - 3, 0.02) << f;
  }
  for (int f = 10; f <= 40; ++f) EXPECT_NEAR(hips_velocity_around(walking.clips[0], f, 0.5).y(), 1.2, 0.02) << f;
}

TEST(HipsVelocity, TurnsAsTheBodyDoesAndNotAsItSwaysInAStep) {
  constexpr double kStep = 0.5, kSway = 0.1;  // s, rad
  Gait gait;
  gait.turn = 0.4;
  Clip clip = gait_clip(gait);
  for (int f = 0; f < clip.frames; ++f) {
    clip.headings[f] += kSway * std::sin(2 * kPi * f / clip.rate / kStep);
  }
  const PackedPool pool = one_fragment(std::move(clip), 20, 40);
  double fastest = 0;
  for (double f = 20; f <= 40; f += 0.5) {
    EXPECT_NEAR(travel_around(pool.clips[0], f, kStep).turn_rate, 0.4, 0.02) << f;
    fastest = std::max(fastest, travel_around(pool.clips[0], f, 0.05).turn_rate);
  }
  EXPECT_GT(fastest, 1);
}

TEST(HipsVelocity, IsOverAFragmentThatOfTheFragmentAndAtATakesEndThatOfWhatIsLeft) {
  const PackedPool pool = one_fragment(braking_clip(), 6, 24);
  const PackedClip& clip = pool.clips[0];
  EXPECT_LT((mean_velocity_around(clip, pool.fragments[0], 0.4) - hips_velocity(clip, pool.fragments[0])).norm(), 0.02);
  EXPECT_NEAR(hips_velocity_around(clip, 0, 0.4).y(), 2 * 0.2 / 2 - 3, 0.02);
  EXPECT_TRUE(hips_velocity_around(clip, clip.frames + 100.0, 0.4).allFinite());
}

TEST(HipsVelocity, AtAFragmentsEndsIsThatOfASteadyGaitOrWhatIsLeftOfOneThatBrakes) {
  const auto ends = [](Clip clip, int begin, int end) {
    return end_velocities(one_fragment(std::move(clip), begin, end))[0];
  };
  const EndVelocities steady = ends(gait_clip({}), 10, 40), brakes = ends(braking_clip(), 0, 27),
                      short_one = ends(braking_clip(), 10, 12);
  EXPECT_LT((steady.last - steady.first).norm(), 0.06);
  EXPECT_NEAR(steady.first.y(), 1.2, 0.06);
  EXPECT_NEAR((brakes.last - brakes.first).norm(), 2 * 0.8, 0.06);
  EXPECT_LT(brakes.last.norm(), brakes.first.norm());
  EXPECT_LT((short_one.last - short_one.first).norm(), 0.06) << "too short to tell";
}

}  // namespace
}  // namespace fragmotion

// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "fragments/gait_heights.hpp"
#include "fragments/synthesis.hpp"
#include "measured_clips.hpp"

namespace fragmotion {
namespace {

constexpr double kCrouch = 0.5;  // m

Clip crouched(Clip clip) {
  for (std::size_t z = 2; z < clip.root_positions.size(); z += 3) clip.root_positions[z] -= kCrouch;
  return clip;
}

// Walks ahead, and one to the side that is crouched.
FragmentPool walks_and_a_crouch() {
  Gait ahead, aside;
  ahead.seconds = 6;
  aside.x = 1.2, aside.y = 0;
  return gait_pool({gait_clip(ahead), gait_clip(ahead), crouched(gait_clip(aside))});
}

double mean_height(const FragmentPool& pool, const Fragment& f) {
  const Clip& clip = pool.clips[f.clip];
  double sum = 0;
  for (int frame = f.begin; frame < f.end; ++frame) sum += clip.root_positions[std::size_t{3} * frame + 2];
  return sum / (f.end - f.begin);
}

TEST(GaitHeights, TellWhatIsCrouchedAmongWalks) {
  const FragmentPool pool = walks_and_a_crouch();
  const Trajectories t = trajectories(pool);
  const GaitHeights usual(t, pool.fragments, ControlSpace(1.2, 3.3));
  for (int f = 0; f < t.count; ++f) {
    const double excess = usual.excess(f, f, pool.fragments[f].evident.speed());
    if (pool.fragments[f].clip == 2) {
      EXPECT_NEAR(excess * t.reach, kCrouch * t.tips, 0.2 * kCrouch * t.tips) << f;
    } else {
      EXPECT_LT(excess * t.reach, 0.1 * kCrouch * t.tips) << f;
    }
  }
}

TEST(GaitHeights, AreThoseOfWhatGoesStraightAheadAlthoughMostDoesNot) {
  Gait ahead, aside;
  aside.x = 1.2, aside.y = 0, aside.seconds = 9;
  const FragmentPool pool = gait_pool({gait_clip(ahead), crouched(gait_clip(aside))});
  const Trajectories t = trajectories(pool);
  const GaitHeights usual(t, pool.fragments, ControlSpace(1.2, 3.3));
  for (int f = 0; f < t.count; ++f) {
    const double excess = usual.excess(f, f, pool.fragments[f].evident.speed());
    if (pool.fragments[f].clip == 1) EXPECT_GT(excess, kCrouch);
  }
}

TEST(GaitHeights, AreThoseOfWhatIsMade) {
  FragmentPool pool = walks_and_a_crouch();
  const std::size_t captured = pool.fragments.size();
  const double upright = mean_height(pool, pool.fragments[0]);
  const ControlSpace space(1.2, 3.3);
  synthesize(pool, space, upright, 0.5);
  int sideways = 0;
  for (std::size_t i = captured; i < pool.fragments.size(); ++i) {
    const Fragment& f = pool.fragments[i];
    const bool aside = std::abs(f.evident.x) > 0.6 && !f.evident.jumps();
    if (!aside) continue;
    ++sideways;
    EXPECT_GT(mean_height(pool, f), upright - kCrouch / 2) << i;
  }
  EXPECT_GT(sideways, 10);
}

}  // namespace
}  // namespace fragmotion

// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "fragments/evident.hpp"
#include "fragments/packed_pool.hpp"
#include "fragments/whole_jumps.hpp"
#include "walker.hpp"

namespace fragmotion {
namespace {

constexpr double kRate = 60;

// A stand of 3 s whose hips go as a jump at 1.5 s does: 0.3 s down by 0.2 m, 0.2 s up, 0.4 s in the air, and the same
// back.
Clip jumping_clip() {
  Gait gait{0, 0, 0};
  gait.rate = kRate;
  Clip clip = gait_clip(gait);
  const auto height = [](double t) {
    const double from = std::abs(t - 1.5);  // the apex
    if (from < 0.2) return 4.905 * (0.04 - from * from);
    if (from < 0.4) return -0.2 * std::sin(kPi / 2 * (from - 0.2) / 0.2);
    if (from < 0.7) return -0.1 * (1 + std::cos(kPi * (from - 0.4) / 0.3));
    return 0.0;
  };
  for (int f = 0; f < clip.frames; ++f) clip.root_positions[std::size_t{3} * f + 2] += height(f / kRate);
  return clip;
}

PackedPool pool_of(const Clip& clip, std::vector<Fragment> fragments) {
  const Skeleton skeleton = humanoid();
  return pack(FragmentPool{skeleton, {make_clip(skeleton, clip)}, std::move(fragments)});
}

Fragment fragment(double begin, double end, double jump) {
  Fragment f;
  f.begin = static_cast<int>(std::lround(begin * kRate));
  f.end = static_cast<int>(std::lround(end * kRate));
  f.evident.jump = jump;
  return f;
}

TEST(WholeJumps, BeginWhereTheCrouchDoesAndEndWhereTheLandingDoes) {
  PackedPool pool = pool_of(jumping_clip(), {fragment(0, 1.3, 0), fragment(1.3, 1.7, 1), fragment(1.7, 2.9, 0)});
  find_whole_jumps(pool);
  const Fragment& jump = pool.fragments[1];
  EXPECT_NEAR(jump.first_played() / kRate, 0.8, 0.1);  // the hips begin to sink slowly
  EXPECT_NEAR(jump.last_played() / kRate, 2.2, 0.1);
  for (const int other : {0, 2}) {
    EXPECT_EQ(pool.fragments[other].first_played(), pool.fragments[other].begin);
    EXPECT_EQ(pool.fragments[other].last_played(), pool.fragments[other].end);
  }
}

TEST(WholeJumps, LendSomeOfTheJumpToCrouchAndLandingAlone) {
  FragmentPool pool{humanoid(), {make_clip(humanoid(), jumping_clip())}, {}};
  pool.fragments = {fragment(0, 0.8, 0), fragment(0.8, 1.3, 0), fragment(1.3, 1.7, 1), fragment(1.7, 2.2, 0),
                    fragment(2.2, 2.9, 0)};
  lead_to_jumps(pool);
  const double led = pool.fragments[1].evident.jump;
  EXPECT_GT(led, 0.3);
  EXPECT_FALSE(pool.fragments[1].evident.jumps());
  EXPECT_EQ(pool.fragments[3].evident.jump, led);
  for (const int other : {0, 4}) EXPECT_EQ(pool.fragments[other].evident.jump, 0);
}

TEST(WholeJumps, StayWithinWhatBelongsTogether) {
  PackedPool pool = pool_of(jumping_clip(), {fragment(0, 1.1, 0), fragment(1.2, 1.3, 0), fragment(1.3, 1.7, 1)});
  find_whole_jumps(pool);
  EXPECT_EQ(pool.fragments[2].first_played(), pool.fragments[1].begin);
  EXPECT_EQ(pool.fragments[2].last_played(), pool.fragments[2].end);
  pool.fragments[2].origin = Origin::transformed;
  find_whole_jumps(pool);
  EXPECT_LT(pool.fragments[2].first_played(), pool.fragments[1].begin);
  EXPECT_GT(pool.fragments[2].last_played(), pool.fragments[2].end);
}

TEST(WholeJumps, HoldFromTheFirstFrameToTheLastWhereTheJumpIsAll) {
  const Clip clip = jumping_clip();
  PackedPool pool = pool_of(clip, {fragment(1.3, 1.7, 1)});
  pool.fragments[0].origin = Origin::transformed;
  pool.fragments[0].begin = 0;
  pool.fragments[0].end = clip.frames - 1;
  find_whole_jumps(pool);
  EXPECT_EQ(pool.fragments[0].lead_in, 0);
  EXPECT_EQ(pool.fragments[0].lead_out, 0);
}

}  // namespace
}  // namespace fragmotion

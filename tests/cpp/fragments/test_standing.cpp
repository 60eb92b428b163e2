// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "fragments/standing.hpp"
#include "measured_clips.hpp"
#include "motion/legs.hpp"
#include "motion/mirror.hpp"

namespace fragmotion {
namespace {

TEST(Standing, StandsStillOnTheGround) {
  for (const bool with_mirror : {false, true}) {
    std::vector<Clip> clips = gait_takes();
    clips.erase(clips.begin());  // without the take that stands
    if (with_mirror) {
      const Mirror mirror(kKinematics, clips);
      for (std::size_t i = 0, count = clips.size(); i < count; ++i) clips.push_back(mirror(clips[i]));
    }
    const FragmentPool pool = gait_pool(clips);
    const Clip stand = make_clip(kSkeleton, standing(kKinematics, find_legs(kKinematics, clips), pool, 16, 30));
    ASSERT_EQ(stand.frames, 16);
    const Control found = evident_of(stand, 0, 15, usual_of(clips));
    for (const double value : {found.x, found.y, found.turn, found.jump}) EXPECT_NEAR(value, 0, 1e-9);
    EXPECT_NEAR(lowest_tip(stand, 0), 0, 0.03);
    EXPECT_NEAR(lowest_tip(stand, 15), 0, 0.03);
    PosedBones posed(kSkeleton.size());
    world(kKinematics, stand, 0, posed.heads.data(), posed.rotations.data());
    for (const Leg& leg : resting_legs(kSkeleton)) {
      const Vector3 down = posed.heads[leg.foot] - posed.heads[leg.thigh];
      EXPECT_LT(down.head<2>().norm(), 0.02);  // the feet under the hips, on legs that are nearly straight
      EXPECT_GT(down.norm(), 0.97 * 0.86);
      const Vector3 forward = posed.rotations[leg.foot] * kSkeleton.tips[leg.foot],
                    facing =
                        stand.headings[0] == 0 ? Vector3::UnitY() : frame_at(stand, 0).rotation() * Vector3::UnitY();
      EXPECT_GT(forward.dot(facing) / forward.head<2>().norm(), std::cos(0.2));
    }
  }
}

TEST(Standing, LivesOverFeetThatStayAndBeginsAgainWhereItBegan) {
  std::vector<Clip> clips = gait_takes();
  clips.erase(clips.begin());  // without the take that stands
  const FragmentPool pool = gait_pool(clips);
  const Legs legs = find_legs(kKinematics, clips);
  const int cycle = 24 * 30, frames = cycle + 10;
  const Clip stand = make_clip(kSkeleton, living_stand(kKinematics, legs, pool, cycle, frames, 30));
  ASSERT_EQ(stand.frames, frames);
  PosedBones first(kSkeleton.size()), now(kSkeleton.size()), last(kSkeleton.size());
  world(kKinematics, stand, 0, first.heads.data(), first.rotations.data());
  Vector2 least = first.heads[0].head<2>(), most = least;
  double turned = 0;
  const int head = kSkeleton.roles.head;
  for (int f = 0; f < frames; ++f) {
    world(kKinematics, stand, f, now.heads.data(), now.rotations.data());
    for (const Leg& leg : legs) {
      EXPECT_NEAR((now.heads[leg.foot] - first.heads[leg.foot]).norm(), 0, 1e-3) << f;
      EXPECT_NEAR(now.rotations[leg.foot].angularDistance(first.rotations[leg.foot]), 0, 1e-6) << f;
    }
    least = least.cwiseMin(now.heads[0].head<2>());
    most = most.cwiseMax(now.heads[0].head<2>());
    turned = std::max(turned, now.rotations[head].angularDistance(first.rotations[head]));
    if (f > 0) {
      EXPECT_LT((now.heads[0] - last.heads[0]).norm() * stand.rate, 0.1) << f;
      EXPECT_LT(now.rotations[head].angularDistance(last.rotations[head]) * stand.rate, 1) << f;
    }
    std::swap(now, last);
  }
  const Vector2 sway = most - least;
  EXPECT_GT(sway.minCoeff(), 0.015);
  EXPECT_LT(sway.maxCoeff(), 0.12);
  EXPECT_GT(turned, 0.1);
  for (int f = 0; f < 10; ++f) {
    world(kKinematics, stand, f, first.heads.data(), first.rotations.data());
    world(kKinematics, stand, cycle + f, now.heads.data(), now.rotations.data());
    for (int b = 0; b < kSkeleton.size(); ++b) EXPECT_LT((now.heads[b] - first.heads[b]).norm(), 1e-6);
  }
}

}  // namespace
}  // namespace fragmotion

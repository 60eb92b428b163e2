// SPDX-License-Identifier: MIT
// Who holds the arms out for a calibration does not stand so.
#include <gtest/gtest.h>

#include <functional>

#include "fragments/t_poses.hpp"
#include "measured_clips.hpp"

namespace fragmotion {
namespace {

const ControlSpace kGaits(1.2, 3.3, ControlSpace().turn_rate(), 1);

using ByTime = std::function<double(double)>;

// `clip` with arms that are raised to the sides by angles, rad, as of times, s.
Clip with_arms(Clip clip, const ByTime& raised) {
  for (int f = 0; f < clip.frames; ++f) {
    for (const double side : {1.0, -1.0}) {
      const int arm = kSkeleton.find(side > 0 ? "upper_arm.L" : "upper_arm.R");
      store_quaternion(Quaternion(Eigen::AngleAxisd(-side * raised(f / clip.rate), Vector3::UnitY())),
                       &clip.rotations[std::size_t{4} * (f * kSkeleton.size() + arm)]);
    }
  }
  return clip;
}

Clip walks(double speed, double seconds) {
  Gait gait;
  gait.y = speed;
  gait.seconds = seconds;
  return gait_clip(gait);
}

// Down for two seconds, a T pose from 2.5 to 3.5 s, and down again from 4 s on.
double into_a_t_pose(double t) {
  const auto up = [&](double since) { return std::clamp((t - since) / 0.5, 0.0, 1.0); };
  return kPi / 2 * (up(2) - up(3.5));
}

double always_out(double) { return kPi / 2; }

TEST(TPoses, AreLeftOutWithTheSwingsToThemAndBack) {
  FragmentPool pool = gait_pool({with_arms(walks(0, 6), into_a_t_pose), walks(1.2, 6)});
  const std::vector<int> before = fragments_by_clip(pool);
  drop_t_poses(pool, kGaits);
  double seconds = 0;
  for (const Fragment& f : pool.fragments) {
    if (f.clip != 0) continue;
    seconds += pool.seconds(f);
    for (int frame = f.begin; frame <= f.end; ++frame)
      EXPECT_LT(into_a_t_pose(frame / pool.clips[0].rate), 0.42) << frame;
  }
  EXPECT_GT(seconds, 3) << "of four in which the arms hang";
  EXPECT_EQ(fragments_by_clip(pool)[1], before[1]);
}

TEST(TPoses, AreHowABodyStandsWhoseArmsAreAlwaysOut) {
  FragmentPool pool = gait_pool({with_arms(walks(0, 3), always_out), with_arms(walks(1.2, 6), always_out)});
  const std::vector<int> before = fragments_by_clip(pool);
  drop_t_poses(pool, kGaits);
  EXPECT_EQ(fragments_by_clip(pool), before);
}

TEST(TPoses, AreNoWalksOnARope) {
  FragmentPool pool =
      gait_pool({with_arms(walks(0, 3), always_out), with_arms(walks(1.2, 3), always_out), walks(1.2, 6), walks(3, 6)});
  std::vector<int> left = fragments_by_clip(pool);
  left[0] = 0;
  drop_t_poses(pool, kGaits);
  EXPECT_EQ(fragments_by_clip(pool), left);
}

TEST(TPoses, StayWhereNothingElseIsLeft) {
  FragmentPool pool = gait_pool({with_arms(walks(0, 3), always_out)});
  const std::vector<int> before = fragments_by_clip(pool);
  drop_t_poses(pool, kGaits);
  EXPECT_EQ(fragments_by_clip(pool), before);
}

}  // namespace
}  // namespace fragmotion

// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>

#include "fragments/blend.hpp"
#include "fragments/distance.hpp"
#include "measured_clips.hpp"

namespace fragmotion {
namespace {

// The pool with a clip's frames 0 .. end as one more fragment.
Trajectories with(FragmentPool pool, const Clip& clip, int end) {
  Fragment fragment;
  fragment.clip = static_cast<int>(pool.clips.size());
  fragment.end = end;
  pool.clips.push_back(make_clip(pool.skeleton, clip));
  pool.fragments.push_back(fragment);
  return trajectories(pool);
}

TEST(Interpolated, AtItsEndsIsTheOneOrTheOther) {
  Gait slow, fast;
  fast.y = 1.8;
  fast.heading = 2;
  const FragmentPool pool = gait_pool({gait_clip(slow), gait_clip(fast)});
  const int a = 2, b = static_cast<int>(pool.fragments.size()) - 3, last = static_cast<int>(pool.fragments.size());
  for (const double w : {0.0, 1.0}) {
    const Clip clip = interpolated(kKinematics, pool, pool.fragments[a], pool.fragments[b], w, 4);
    const Trajectories t = with(pool, clip, clip.frames - 1 - 4);
    EXPECT_LT(fragment_distance(t, last, w == 0 ? a : b), 1e-3);
    EXPECT_GT(fragment_distance(t, last, w == 0 ? b : a), 1);
  }
}

TEST(Interpolated, LiesBetweenWhatItIsMadeOf) {
  Gait slow, fast;
  fast.y = 1.8;
  const FragmentPool pool = gait_pool({gait_clip(slow), gait_clip(fast)});
  const double usual = usual_of(pool.clips);
  for (const Fragment& a : pool.fragments) {
    const Fragment& b = pool.fragments.back();
    const Clip clip = interpolated(kKinematics, pool, a, b, 0.5, 0);
    const double seconds = (clip.frames - 1) / clip.rate, mean = (pool.seconds(a) + pool.seconds(b)) / 2;
    EXPECT_NEAR(seconds, mean, 0.5 / clip.rate + 1e-9);
    const double speed = evident_of(clip, 0, clip.frames - 1, usual).y;
    EXPECT_GT(speed, std::min(a.evident.y, b.evident.y) - 0.15);
    EXPECT_LT(speed, std::max(a.evident.y, b.evident.y) + 0.15);
  }
}

}  // namespace
}  // namespace fragmotion

// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "fragments/coverage.hpp"
#include "fragments/speed_range.hpp"
#include "fragments/synthesis.hpp"
#include "measured_clips.hpp"
#include "mocap_files.hpp"
#include "motion/legs.hpp"

namespace fragmotion {
namespace {

FragmentPool synthesized(std::vector<Clip> clips, const ControlSpace& space) {
  FragmentPool pool = gait_pool(clips, 1, {}, &space);
  synthesize(pool, space, usual_of(clips));
  return pool;
}

// ControlDis to the nearest fragment.
double nearest(const FragmentPool& pool, const Control& control, const ControlSpace& space) {
  double least = std::numeric_limits<double>::infinity();
  for (const Fragment& f : pool.fragments) least = std::min(least, space.distance(f.evident, control));
  return least;
}

TEST(Synthesize, OnlyAddsAndBringsControlsNearer) {
  const std::vector<Clip> clips = gait_takes();
  const ControlSpace space(1.2, 3, 1.2, 1.8 / stature(kSkeleton));
  const FragmentPool before = gait_pool(clips, 1, {}, &space), after = synthesized(clips, space);
  ASSERT_GT(after.fragments.size(), before.fragments.size());
  for (std::size_t i = 0; i < before.fragments.size(); ++i) {
    EXPECT_EQ(after.fragments[i].begin, before.fragments[i].begin);
    EXPECT_EQ(after.fragments[i].evident.y, before.fragments[i].evident.y);
  }
  const SpeedRange speeds(before.fragments, space);
  double sum_was = 0, sum_is = 0;
  for (int c = 0; c < kPaperPoints; ++c) {
    const Control able = speeds.within(space.point(c));
    const double was = nearest(before, able, space), is = nearest(after, able, space);
    EXPECT_LE(is, was);
    if (space.nearest(able) != c) continue;
    sum_was += was;
    sum_is += is;
  }
  EXPECT_LT(sum_is, 0.5 * sum_was);
}

TEST(Synthesize, GoesAsFastAsMayBeWhereNoTakeIsAsFastAsIsAsked) {
  const std::vector<Clip> clips = gait_takes();  // aside they go at 1.2 m/s
  const ControlSpace space(0.9, 2, 1.2, 1.8 / stature(kSkeleton));
  const SpeedRange speeds(gait_pool(clips, 1, {}, &space).fragments, space);
  const Control aside{2, 0, 0, 0}, able = speeds.within(aside);
  ASSERT_LT(able.speed(), 1.9);
  ASSERT_EQ(space.nearest(able), space.nearest(aside));
  EXPECT_LT(nearest(synthesized(clips, space), able, space), 0.15);
}

TEST(Synthesize, GoesRoundAndRoundWhereNoTakeGoesOn) {
  const std::vector<Clip> clips = gait_takes();
  const ControlSpace space(1.2, 3, 1.2, 1.8 / stature(kSkeleton));
  const Control run{0, 3, 0, 0};
  const auto rounds = [&](const FragmentPool& pool) {
    int count = 0;
    for (const Fragment& f : pool.fragments)
      count += f.origin == Origin::transformed && space.distance(f.evident, run) <= kPerformed ? 1 : 0;
    return count;
  };
  FragmentPool pool = gait_pool(clips, 1, {}, &space), alone = pool;
  synthesize(pool, space, usual_of(clips));
  EXPECT_EQ(rounds(pool), 0) << "takes run on";
  alone.fragments.clear();
  for (const Fragment& f : gait_pool(clips, 1, {}, &space).fragments) {  // every other one of what runs
    const bool runs = space.distance(f.evident, run) <= kPerformed;
    if (!runs || alone.fragments.back().end != f.begin) alone.fragments.push_back(f);
  }
  synthesize(alone, space, usual_of(clips));
  EXPECT_GE(rounds(alone), 2);
}

TEST(Synthesize, SaysTruelyWhatItsFragmentsAre) {
  const std::vector<Clip> clips = gait_takes();
  const ControlSpace space(1.2, 3, 1.2, 1.8 / stature(kSkeleton));
  const double usual = usual_of(clips);
  const FragmentPool pool = synthesized(clips, space);
  int made = 0;
  for (const Fragment& f : pool.fragments) {
    ASSERT_TRUE(f.clip >= 0 && f.clip < static_cast<int>(pool.clips.size()));
    const Clip& clip = pool.clips[f.clip];
    ASSERT_TRUE(f.begin >= 0 && f.begin < f.end && f.end < clip.frames);
    if (f.origin == Origin::captured) continue;
    ++made;
    EXPECT_NE(f.origin, Origin::mirrored);
    EXPECT_GE(pool.seconds(f), 0.1 - 1e-9);
    EXPECT_LE(pool.seconds(f), 0.5 + 1.0 / clip.rate);
    const Control found = evident_of(clip, f.begin, f.end, usual, space);
    EXPECT_NEAR(space.distance(found, f.evident), 0, 1e-6);
  }
  EXPECT_GT(made, 50);
}

// The greatest speed of a knee, m/s.
double fastest_knee(const Clip& clip, int begin, int end) {
  const Legs legs = find_legs(kKinematics, {clip});
  PosedBones posed(kKinematics.bones());
  std::array<Vector3, 2> before;
  double most = 0;
  for (int f = begin; f <= end; ++f) {
    world(kKinematics, clip, f, posed.heads.data(), posed.rotations.data());
    for (int side = 0; side < 2; ++side) {
      const Vector3 now = posed.heads[legs[side].knee];
      if (f > begin) most = std::max(most, (now - before[side]).norm() * clip.rate);
      before[side] = now;
    }
  }
  return most;
}

TEST(Synthesize, GoesBackwardWithoutKneesThatSnap) {
  Gait run;
  run.y = 3;
  run.cycle = 0.8;
  run.rate = 60;
  const Clip clip = gait_clip(run);
  const ControlSpace space(1.2, 3, 1.2, 1.8 / stature(kSkeleton));
  const FragmentPool pool = synthesized({clip}, space);
  const double own = fastest_knee(pool.clips[0], 0, pool.clips[0].frames - 1);
  int found = 0;
  for (const Fragment& f : pool.fragments) {
    if (f.origin != Origin::transformed || f.evident.y > -1 || f.evident.jump > 0.5) continue;
    ++found;
    EXPECT_LT(fastest_knee(pool.clips[f.clip], f.begin, f.end), 1.1 * own);
  }
  EXPECT_GT(found, 1);
}

TEST(Synthesize, RefusesALengthOutOfItsRange) {
  FragmentPool pool = gait_pool({gait_clip({})});
  for (const double bad : {-1.0, std::nan(""), 1e8, double(INFINITY)}) {
    const std::string error = error_of([&] { synthesize(pool, ControlSpace(), 1, bad); });
    EXPECT_NE(error.find("longest fragment (s) must be 0.1 to 10"), std::string::npos) << bad;
  }
}

TEST(Synthesize, LetsEveryCharacterStand) {
  Gait run;
  run.y = 3;
  const ControlSpace space(1.2, 3, 1.2, 1.8 / stature(kSkeleton));
  const FragmentPool pool = synthesized({gait_clip(run)}, space);
  EXPECT_LT(coverage(pool.fragments, space).distances[space.nearest({})], 0.05);  // it sways
}

// As a take stands for three seconds or more, or as one that is made and does for longer; nothing else is made.
TEST(Synthesize, StandsOnForLong) {
  const ControlSpace space(1.2, 3, 1.2, 1.8 / stature(kSkeleton));
  for (const double seconds : {0.0, 1.0, 6.0}) {
    std::vector<Clip> clips = gait_takes();
    Gait gait;
    gait.y = 0;
    gait.seconds = seconds;
    clips.erase(clips.begin());
    if (seconds > 0) clips.push_back(gait_clip(gait, "stand"));
    const FragmentPool pool = synthesized(clips, space);
    double standing = 0;
    for (const Fragment& f : pool.fragments) {
      if (pool.clips[f.clip].name != "standing") continue;
      EXPECT_LT(space.distance(f.evident, {}), 0.3);
      EXPECT_GT(pool.clips[f.clip].frames, 20 * 30) << "it plays nothing that only stands still";
      standing += pool.seconds(f);
    }
    if (seconds > 3) {
      EXPECT_EQ(standing, 0);
    } else {
      EXPECT_GT(standing, 20) << seconds;
    }
  }
}

// A stand of two seconds that leans from side to side so many times, faster in a fragment than one would stand in it.
Clip leaning(double times) {
  Gait gait;
  gait.y = 0, gait.seconds = 2;
  Clip clip = gait_clip(gait, "idle");
  const double height = clip.root_positions[2];
  for (int f = 0; f < clip.frames; ++f) {
    const double lean = 0.08 / height * std::sin(2 * kPi * times * f / (clip.frames - 1));
    clip.root_positions[std::size_t{3} * f] += height * std::sin(lean);
    double* hips = &clip.rotations[std::size_t{4} * (f * kSkeleton.size() + kSkeleton.roles.hips)];
    store_quaternion(Quaternion{Eigen::AngleAxisd(lean, Vector3::UnitY())} * load_quaternion(hips), hips);
  }
  return make_clip(kSkeleton, clip);
}

TEST(Synthesize, StandsAsALoopDoesThatShiftsItsWeight) {
  const ControlSpace space(1.2, 3, 1.2, 1.8 / stature(kSkeleton));
  for (const double times : {1.0, 1.25}) {
    std::vector<Clip> clips = gait_takes();
    clips.erase(clips.begin());
    clips.push_back(leaning(times));
    const FragmentPool pool = synthesized(clips, space);
    const bool is_made =
        std::any_of(pool.clips.begin(), pool.clips.end(), [](const Clip& clip) { return clip.name == "standing"; });
    EXPECT_EQ(is_made, times != 1) << "the other does not end as it begins";
    double fastest = 0;
    for (const Fragment& f : pool.fragments) {
      if (pool.clips[f.clip].name == "idle") fastest = std::max(fastest, space.distance(f.evident, {}));
    }
    EXPECT_GT(fastest, kPerformed);
  }
}

TEST(Synthesize, IsDeterministic) {
  const ControlSpace space(1.2, 3, 1.2, 1.8 / stature(kSkeleton));
  const FragmentPool one = synthesized(gait_takes(), space), two = synthesized(gait_takes(), space);
  ASSERT_EQ(one.clips.size(), two.clips.size());
  for (std::size_t i = 0; i < one.clips.size(); ++i) EXPECT_EQ(one.clips[i].rotations, two.clips[i].rotations);
}

}  // namespace
}  // namespace fragmotion

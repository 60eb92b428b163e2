// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "build/build.hpp"
#include "control/simulated_players.hpp"
#include "fragments/body_pose.hpp"
#include "fragments/closed_cycles.hpp"
#include "fragments/synthesis.hpp"
#include "measured_clips.hpp"
#include "motion/mirror.hpp"

namespace fragmotion {
namespace {

constexpr double kCycle = 0.6;  // s, of the run

Clip run_of(double seconds) {
  Gait run;
  run.y = 3;
  run.turn = 0.3;
  run.cycle = kCycle;
  run.seconds = seconds;
  run.rate = 60;
  return gait_clip(run, "run");
}

ControlSpace space() { return ControlSpace(1.2, 3, 1.2, 1.8 / stature(kSkeleton)); }

// A walk and such a run, and then their mirror images.
FragmentPool walk_and_run(double seconds, const Gait& walk = {}) {
  std::vector<Clip> clips{gait_clip(walk, "walk"), run_of(seconds)};
  const Mirror mirror(kKinematics, clips);
  for (int c = 0; c < 2; ++c) clips.push_back(mirror(clips[c]));
  const ControlSpace controls = space();
  FragmentPool pool = gait_pool(clips, 1, {}, &controls);
  for (Fragment& f : pool.fragments) f.origin = f.clip < 2 ? Origin::captured : Origin::mirrored;
  return pool;
}

std::vector<ClosedCycle> cycles_of(const FragmentPool& pool) {
  return closed_cycles(pool, trajectories(pool), space(), 2);
}

// The cycle of a step of the run, forward or backward.
ClosedCycle step_of(const FragmentPool& pool, bool backward) {
  const std::vector<ClosedCycle> cycles = cycles_of(pool);
  const auto found = std::find_if(cycles.begin(), cycles.end(), [&](const ClosedCycle& cycle) {
    return cycle.clip == 1 && cycle.is_step() && cycle.backward() == backward;
  });
  return found == cycles.end() ? ClosedCycle{} : *found;
}

GaitSource gait_of(const FragmentPool& pool, const ClosedCycle& step) {
  const Clip &clip = pool.clips[step.clip], &image = pool.clips[step.image];
  return gait_of_step(kKinematics, pool, step, find_contacts(kKinematics, clip), find_contacts(kKinematics, image));
}

// The greatest way of a bone's head from a frame to the next, m.
double fastest(const Clip& clip, int begin, int end) {
  PosedBones before(kKinematics.bones()), now(kKinematics.bones());
  double most = 0;
  for (int f = begin; f <= end; ++f) {
    world(kKinematics, clip, f, now.heads.data(), now.rotations.data());
    for (int b = 0; f > begin && b < kKinematics.bones(); ++b)
      most = std::max(most, (now.heads[b] - before.heads[b]).norm());
    std::swap(before, now);
  }
  return most;
}

TEST(ClosedCycles, OfATakeOfOneStepAreThatStepAndItsMirrorImage) {
  const FragmentPool pool = walk_and_run(0.5);
  const ClosedCycle forward = step_of(pool, false), backward = step_of(pool, true);
  ASSERT_TRUE(forward.is_step() && backward.is_step());
  EXPECT_EQ(pool.clips[forward.image].name, "run mirrored");
  EXPECT_NEAR(forward.evident.y, 3, 0.2);
  EXPECT_NEAR(backward.evident.y, -3, 0.2);
  EXPECT_EQ(forward.evident.x, 0);
  EXPECT_EQ(forward.evident.turn, 0);
}

TEST(ClosedCycles, AreWholeWhereATakeHoldsOneOfTheGait) {
  int runs = 0;
  for (const ClosedCycle& cycle : cycles_of(walk_and_run(3))) {
    EXPECT_FALSE(cycle.is_step());
    runs += cycle.clip == 1 ? 1 : 0;
  }
  EXPECT_GT(runs, 0);
}

// A walk ahead, a run back, and a run ahead of a step alone: that step is a gait, as the run back is another one.
TEST(ClosedCycles, ArePlayedBackwardOnlyWhereNoneGoesThatWay) {
  Gait back;
  back.y = -3, back.cycle = kCycle, back.seconds = 3, back.rate = 60;
  std::vector<Clip> clips{gait_clip(back, "back"), run_of(0.5), gait_clip({}, "walk")};
  const Mirror mirror(kKinematics, clips);
  for (int c = 0; c < 3; ++c) clips.push_back(mirror(clips[c]));
  const ControlSpace controls = space();
  FragmentPool pool = gait_pool(clips, 1, {}, &controls);
  for (Fragment& f : pool.fragments) f.origin = f.clip < 3 ? Origin::captured : Origin::mirrored;
  int steps = 0, walks_back = 0;
  for (const ClosedCycle& cycle : closed_cycles(pool, trajectories(pool), controls, 3)) {
    if (cycle.evident.speed() > 2) EXPECT_FALSE(cycle.backward());
    steps += cycle.is_step() && cycle.evident.y > 2 ? 1 : 0;
    walks_back += cycle.backward() && cycle.clip == 2 ? 1 : 0;
  }
  EXPECT_GT(steps, 0);
  EXPECT_GT(walks_back, 0);
}

TEST(ClosedCycles, OfHurriedStepsAreFlawed) {
  Gait usual, hurried;
  usual.y = hurried.y = 3, usual.seconds = 6, hurried.seconds = 1.5, usual.rate = hurried.rate = 60;
  usual.cycle = 0.9, hurried.cycle = 0.6;
  const ControlSpace controls = space();
  const FragmentPool pool = gait_pool({gait_clip(usual), gait_clip(hurried)}, 1, {}, &controls);
  double least[2] = {1, 1};
  for (const ClosedCycle& cycle : closed_cycles(pool, trajectories(pool), controls, 2))
    least[cycle.clip] = std::min(least[cycle.clip], cycle.flaw * kFlawed);
  EXPECT_GT(least[1], least[0] + 0.9 * effort_of_speed(1.5));
}

// As who limps or is large goes: whose pose, a third of a second later, is nearly the same.
TEST(ClosedCycles, OfAGaitOfLongStepsGoRoundWithItsFeet) {
  Gait limp;
  limp.y = 0.5, limp.cycle = 3, limp.seconds = 7;
  const FragmentPool pool = walk_and_run(3, limp);
  int limps = 0;
  for (const ClosedCycle& cycle : cycles_of(pool)) {
    if (cycle.clip != 0 || cycle.is_step() || std::abs(cycle.evident.y) < 0.3) continue;
    EXPECT_NEAR(std::abs(cycle.end - cycle.begin) / pool.clips[0].rate, limp.cycle, 0.1 * limp.cycle);
    ++limps;
  }
  EXPECT_GT(limps, 0);
}

TEST(ClosedCycles, AStepThatIsNoneIsNoGait) {
  const FragmentPool pool = walk_and_run(0.2);
  for (const ClosedCycle& cycle : cycles_of(pool)) EXPECT_NE(cycle.clip, 1);
}

TEST(GaitOfStep, GoesStraightOnAndAroundWithoutAJump) {
  const FragmentPool pool = walk_and_run(0.5);
  const ClosedCycle step = step_of(pool, false);
  ASSERT_TRUE(step.is_step());
  const GaitSource gait = gait_of(pool, step);
  EXPECT_EQ(gait.begin, 0);
  EXPECT_EQ(gait.end, 2 * (step.end - step.begin));
  ASSERT_EQ(gait.clip.frames, gait.end + 1);
  EXPECT_LT(fastest(gait.clip, 0, gait.end), 1.3 * fastest(pool.clips[1], 0, pool.clips[1].frames - 1));
  const BodyPose first = body_pose(kKinematics, gait.clip, 0), last = body_pose(kKinematics, gait.clip, gait.end);
  for (std::size_t i = 0; i < first.rotations.size(); ++i) EXPECT_NEAR(first.rotations[i], last.rotations[i], 1e-6);
  EXPECT_NEAR(first.frame.heading, last.frame.heading, 1e-6);
  EXPECT_GT((last.frame.position - first.frame.position).norm(), 0.8 * 3 * kCycle);
}

TEST(GaitOfStep, StandsOnOneFootAsItStoodOnTheOther) {
  const FragmentPool pool = walk_and_run(0.5);
  const ClosedCycle step = step_of(pool, false);
  ASSERT_TRUE(step.is_step());
  const GaitSource gait = gait_of(pool, step);
  int stands = 0;
  for (int f = 0; f < gait.end / 2; ++f) {
    for (int side = 0; side < 2; ++side) {
      EXPECT_EQ(gait.contacts.stands(side, f), gait.contacts.stands(1 - side, f + gait.end / 2)) << f;
      stands += gait.contacts.stands(side, f) ? 1 : 0;
    }
  }
  EXPECT_GT(stands, gait.end / 4);
}

TEST(GaitOfStep, BackwardIsTheSameFromItsEnd) {
  const FragmentPool pool = walk_and_run(0.5);
  const ClosedCycle onward = step_of(pool, false), back = step_of(pool, true);
  ASSERT_TRUE(onward.is_step() && back.is_step());
  const GaitSource forward = gait_of(pool, onward), backward = gait_of(pool, back);
  EXPECT_EQ(backward.begin, forward.end);
  EXPECT_EQ(backward.end, forward.begin);
  EXPECT_EQ(backward.clip.rotations, forward.clip.rotations);
}

// Who has a walk and one step of a run does not run with the walk's steps.
TEST(Build, RunsOnTheOneStepOfARunThatItsTakesHold) {
  BuildOptions options;
  options.policies = {"greedy"};
  options.restarts = 1;
  const Character c = build(kSkeleton, {gait_clip({}, "walk"), run_of(kCycle / 2)},
                            {simulate_trace("explorer", 10, 1, ControlSpace())}, options);
  const std::string walk = "walk";
  int found = 0;
  for (const Fragment& f : c.pool.fragments) {
    if (f.origin != Origin::transformed || f.evident.y < 2 || f.evident.jumps()) continue;
    ++found;
    EXPECT_NE(c.pool.clips[f.clip].name.substr(0, walk.size()), walk);
  }
  EXPECT_GT(found, 0);
}

}  // namespace
}  // namespace fragmotion

// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "dog.hpp"
#include "motion/center_of_mass.hpp"
#include "motion/gait_bounces.hpp"
#include "stilts.hpp"
#include "walker.hpp"

namespace fragmotion {
namespace {

// A gait whose body and feet rise in each step, lowest in the middle of a stance: by `rise` m in the step of a number.
Clip bouncing(const Gait& gait, const std::function<double(int)>& rise) {
  const double step = gait.cycle / 2, lowest = 0.3 * gait.cycle;
  Clip clip = gait_clip(gait);
  for (int f = 0; f < clip.frames; ++f) {
    const double steps = (f / gait.rate - lowest) / step, air = std::sin(kPi * steps);
    clip.root_positions[3 * f + 2] += rise(static_cast<int>(std::floor(steps))) * air * air;
  }
  return clip;
}

std::vector<bool> bounces_of(const Clip& clip, const Skeleton& skeleton = humanoid()) {
  const Kinematics kinematics(skeleton);
  return gait_bounces(kinematics, clip, center_of_mass(kinematics, clip));
}

int count(const std::vector<bool>& flags) { return static_cast<int>(std::count(flags.begin(), flags.end(), true)); }

Gait running() {
  Gait run;
  run.y = 4;
  run.cycle = 0.6;
  return run;
}

TEST(GaitBounces, AreInEveryFrameOfARunThatBouncesAsHighAsAJump) {
  for (const double rise : {0.1, 0.3, 0.5}) {
    const Clip clip = bouncing(running(), [=](int) { return rise; });
    EXPECT_EQ(count(bounces_of(clip)), clip.frames) << rise;
  }
}

TEST(GaitBounces, AreInAGaitOfRigidLegsThatPassEachOtherWhereItIsLowest) {
  const Kinematics kinematics(stilts());
  const Clip clip = stilts_on_the_spot(0.4);
  EXPECT_GT(count(gait_bounces(kinematics, clip, center_of_mass(kinematics, clip))), 0.8 * clip.frames);
}

TEST(GaitBounces, AreInNoneOfHopsThatLandAsTheyTookOff) {
  Gait hops = running();
  hops.y = 0;
  EXPECT_EQ(count(bounces_of(bouncing(hops, [](int) { return 0.3; }))), 0);
}

TEST(GaitBounces, AreNotInALeapOutOfARun) {
  const Gait gait = running();
  const int leap = 4;
  const std::vector<bool> found = bounces_of(bouncing(gait, [=](int step) { return step == leap ? 0.5 : 0.06; }));
  const auto at = [&](double steps) {
    return found[std::lround((0.3 * gait.cycle + steps * gait.cycle / 2) * gait.rate)];
  };
  EXPECT_FALSE(at(leap + 0.5));
  for (const int step : {1, 2, 6, 7}) EXPECT_TRUE(at(step + 0.5)) << step;
}

// A gallop of two flights in a stride of 0.6 s: `rise` m in the flight of a number.
Clip galloping(const std::function<double(int)>& rise) {
  Clip clip = dog_clip({}, true, "gallop");
  for (int f = 0; f < clip.frames; ++f) {
    const double flights = f / clip.rate / 0.3, air = std::sin(kPi * flights);
    clip.root_positions[3 * f + 2] += rise(static_cast<int>(std::floor(flights))) * air * air;
  }
  return clip;
}

TEST(GaitBounces, AreInAGallopThatFliesHigherStretchedThanGathered) {
  const Clip clip = galloping([](int flight) { return flight % 2 == 0 ? 0.25 : 0.08; });
  EXPECT_EQ(count(bounces_of(clip, dog())), clip.frames);
}

TEST(GaitBounces, AreNotInALeapOutOfAGallop) {
  const Clip clip = galloping([](int flight) { return flight == 4 ? 0.5 : flight % 2 == 0 ? 0.25 : 0.08; });
  const std::vector<bool> found = bounces_of(clip, dog());
  const auto at = [&](double flights) { return found[std::lround(flights * 0.3 * clip.rate)]; };
  EXPECT_FALSE(at(4.5));
  for (const int flight : {0, 1, 2, 6, 7}) EXPECT_TRUE(at(flight + 0.5)) << flight;
}

TEST(GaitBounces, AreUnknownWithoutFeet) {
  Skeleton skeleton = humanoid();
  skeleton.roles.left_foot = -1;
  const Kinematics kinematics(skeleton);
  const Clip clip = bouncing(running(), [](int) { return 0.3; });
  EXPECT_EQ(count(gait_bounces(kinematics, clip, center_of_mass(kinematics, clip))), 0);
}

TEST(EvidentControl, IsNoJumpInARunThatBounces) {
  const Kinematics kinematics(humanoid());
  const Clip clip = bouncing(running(), [](int) { return 0.4; });
  const BodyMotion motion = body_motion(kinematics, clip);
  const double usual = usual_height({body_motion(kinematics, gait_clip(running()))});
  EXPECT_EQ(evident_control(motion, clip.rate, 30, 45, usual, ControlSpace()).jump, 0);
}

}  // namespace
}  // namespace fragmotion

// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "motion/contacts.hpp"
#include "motion/foot_paths.hpp"
#include "motion/in_place.hpp"
#include "stilts.hpp"
#include "walker.hpp"

namespace fragmotion {
namespace {

TEST(Contacts, OfHeldFeetEndAsSoonAsTheBallRisesAndGoesAway) {
  Gait gait;
  gait.seconds = 8;
  gait.rate = 60;
  gait.cycle = 2;
  gait.y = 0.6;
  const Clip clip = gait_clip(gait);
  const Kinematics kinematics(humanoid());
  const Contacts stands = find_contacts(kinematics, clip), held = find_plants(kinematics, clip);
  const FootPaths paths = foot_paths(kinematics, clip);
  const double scale = standard_scale(humanoid());
  int sooner = 0;
  for (int side = 0; side < 2; ++side) {
    const std::vector<Vector3>& ball = paths[side].ball;
    for (int f = 1; f + 1 < clip.frames; ++f) {
      EXPECT_LE(held.feet[side][f], stands.feet[side][f]);
      sooner += stands.feet[side][f] && !held.feet[side][f] ? 1 : 0;
      if (!held.feet[side][f] || held.feet[side][f + 1]) continue;
      const double speed = (ball[f + 1] - ball[f - 1]).norm() * clip.rate / 2 * scale;
      EXPECT_TRUE(speed <= 0.25 || ball[f + 1].z() <= ball[f].z()) << "after " << f << " frames";
    }
  }
  EXPECT_GT(sooner, 10);
}

// The hip joint, which is where such a foot begins, is always as low as it gets.
TEST(Contacts, OfLegsOfASingleBoneAreThoseOfTheirEnds) {
  const Kinematics kinematics(stilts());
  const Clip still = stilts_on_the_spot(0.1, 60);
  const FeetWay way = find_feet_way(kinematics, still).value();
  const Clip clip = led(kinematics, still, way, kStiltsPass / way.mean.y());
  const Contacts contacts = find_contacts(kinematics, clip);
  const FootPaths paths = foot_paths(kinematics, clip);
  for (int side = 0; side < 2; ++side) {
    int stands = 0;
    for (int f = 0; f < clip.frames; ++f) {
      stands += contacts.feet[side][f];
      if (contacts.feet[side][f]) EXPECT_LT(paths[side].ball[f].z(), 0.1) << f;
    }
    EXPECT_GT(stands, 0.05 * clip.frames);
    EXPECT_LT(stands, 0.5 * clip.frames);
  }
}

}  // namespace
}  // namespace fragmotion

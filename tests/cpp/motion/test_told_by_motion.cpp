// SPDX-License-Identifier: MIT
// Bodies on four legs whose rest pose does not show it, and whose names are a man's.
#include <gtest/gtest.h>

#include "humanoids.hpp"
#include "lying_dog.hpp"
#include "motion/told_by_motion.hpp"
#include "skeleton/role_map.hpp"

namespace fragmotion {
namespace {

std::string name_of(const Take& take, int bone) { return bone < 0 ? std::string() : take.skeleton.names[bone]; }

TEST(ToldByMotion, LegsAreThoseThatABodyStandsOn) {
  Take walk = lying_dog_take(dog_clip({}, false, "walk"));
  ASSERT_EQ(name_of(walk, walk.skeleton.roles.left_hand), "LeftHand") << "a man's, by the names";
  tell_four_legs({&walk});
  const Roles& roles = walk.skeleton.roles;
  EXPECT_EQ(name_of(walk, roles.hips), "Hips");
  EXPECT_EQ(name_of(walk, roles.head), "Head");
  EXPECT_EQ(name_of(walk, roles.left_thigh), "LeftUpLeg");
  EXPECT_EQ(name_of(walk, roles.right_foot), "RightFoot");
  EXPECT_EQ(name_of(walk, roles.left_fore_leg), "LeftArm");
  EXPECT_EQ(name_of(walk, roles.left_fore_foot), "LeftHand");
  EXPECT_EQ(name_of(walk, roles.right_fore_foot), "RightHand");
  for (const int human : {roles.left_hand, roles.right_hand}) EXPECT_EQ(human, -1);
}

TEST(ToldByMotion, AllTakesOfOneSkeletonTellTogether) {
  Take walk = lying_dog_take(dog_clip({}, false, "walk")), lies = resting_dog_take(), alone = lies;
  lies.frames /= 4;
  lies.translations.resize(lies.translations.size() / 4);
  lies.rotations.resize(lies.rotations.size() / 4);
  tell_four_legs({&alone});
  EXPECT_EQ(alone.skeleton.roles.left_fore_foot, -1) << "which alone tells nothing";
  tell_four_legs({&lies, &walk});
  EXPECT_EQ(lies.skeleton.roles.left_fore_foot, walk.skeleton.roles.left_fore_foot);
  EXPECT_EQ(name_of(lies, lies.skeleton.roles.left_fore_foot), "LeftHand");
}

TEST(ToldByMotion, WhatIsToldStays) {
  Take walk = lying_dog_take(dog_clip({}, false, "walk"));
  tell_four_legs({&walk});
  const RoleMap map = find_role_map(walk.skeleton);
  EXPECT_EQ(roles_of(map).left_fore_foot, walk.skeleton.roles.left_fore_foot);
  EXPECT_EQ(roles_of(map).right_thigh, walk.skeleton.roles.right_thigh);
  EXPECT_EQ(name_of(walk, map.bone(Role::kSpine)), "Spine");
  EXPECT_EQ(map.bone(Role::kShin, Side::kLeft), -1);
}

TEST(ToldByMotion, MissingNumbersTellNothing) {
  Take walk = lying_dog_take(dog_clip({}, false, "walk"));
  for (std::size_t i = 0; i < walk.translations.size() / 2; ++i) walk.translations[i] = std::nan("");
  tell_four_legs({&walk});
  EXPECT_GE(walk.skeleton.roles.left_fore_foot, 0);
  for (double& value : walk.translations) value = std::nan("");
  Take none = lying_dog_take(dog_clip({}, false, "walk"));
  none.translations = walk.translations;
  tell_four_legs({&none});
  EXPECT_EQ(none.skeleton.roles.left_fore_foot, -1);
}

// Its shins lie on the ground behind its knees.
TEST(ToldByMotion, WhoGoesOnHandsAndKneesIsAMan) {
  const Skeleton skeleton = resting_dog_take().skeleton;
  ObservedPoses poses;
  const auto add = [&](bool kneels) {
    for (int b = 0; b < skeleton.size(); ++b) {
      const bool limb = b > 2, fore = b > 8;
      const int joint = limb ? (b - 3) % 3 : 0;
      const double x = !limb ? 0 : (b - 3) / 3 % 2 == 0 ? 0.1 : -0.1;
      const bool shin = limb && !fore && joint == 2 && kneels;
      const double top = kneels && !fore ? 0.46 : 0.88;
      const double ahead = b == 1 || fore ? -0.8 : b == 2 ? -1 : 0;
      poses.heads.emplace_back(x, ahead + (shin ? 0.42 : 0), shin ? 0.02 : top - 0.43 * joint);
    }
    ++poses.poses;
  };
  for (int i = 0; i < 3; ++i) add(true);
  EXPECT_EQ(find_role_map(skeleton, &poses).bone(Role::kForeFoot, Side::kLeft), -1);
  poses = {};
  for (int i = 0; i < 3; ++i) add(false);
  EXPECT_GE(find_role_map(skeleton, &poses).bone(Role::kForeFoot, Side::kLeft), 0);
}

TEST(ToldByMotion, ManWhoStandsAtRestStays) {
  const Skeleton skeleton = humanoid();
  Take take = take_from_clip(skeleton, gait_clip({}, "walk"));
  for (int f = 0; f < take.frames; ++f) {  // on all fours, as far as he can be
    double* turn = &take.rotations[std::size_t{4} * f * skeleton.size()];
    store_quaternion(Quaternion(Eigen::AngleAxisd(kPi / 2, Vector3::UnitX())) * load_quaternion(turn), turn);
  }
  tell_four_legs({&take});
  EXPECT_EQ(take.skeleton.roles.left_fore_foot, -1);
  EXPECT_EQ(take.skeleton.roles.left_hand, skeleton.roles.left_hand);
}

}  // namespace
}  // namespace fragmotion

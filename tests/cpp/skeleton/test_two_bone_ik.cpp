// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "base/random.hpp"
#include "motion/legs.hpp"
#include "walker.hpp"

namespace fragmotion {
namespace {

TEST(Leg, IsFoundByItsRoles) {
  const Skeleton skeleton = humanoid();
  for (const Leg& leg : find_legs(Kinematics(skeleton), {})) {
    ASSERT_TRUE(leg.exists());
    EXPECT_TRUE(skeleton.is_below(leg.foot, leg.knee));
    EXPECT_TRUE(skeleton.is_below(leg.knee, leg.thigh));
  }
  Skeleton footless = skeleton;
  footless.roles.left_foot = -1;
  EXPECT_FALSE(find_legs(Kinematics(footless), {})[0].exists());
}

TEST(Leg, IsNoneWithoutAThighOfItsOwnBelowTheHipsAndAJointAboveTheFoot) {
  const Skeleton whole = humanoid();
  const struct {
    const char* label;
    int Roles::*role;
    int bone;
  } cases[] = {
      {"one thigh", &Roles::right_thigh, -1},
      {"the other thigh", &Roles::left_thigh, -1},
      {"one foot", &Roles::right_foot, -1},
      {"the hips as a thigh", &Roles::left_thigh, whole.roles.hips},
      {"the hips as a foot", &Roles::left_foot, whole.roles.hips},
      {"a foot as the thigh", &Roles::left_thigh, whole.roles.left_foot},
      {"a thigh as the foot", &Roles::right_foot, whole.roles.right_thigh},
      {"a shin as the thigh", &Roles::left_thigh, whole.find("shin.L")},
      {"a foot as the hips", &Roles::hips, whole.roles.left_foot},
      {"a shin as the hips", &Roles::hips, whole.find("shin.R")},
      {"one thigh for both", &Roles::right_thigh, whole.roles.left_thigh},
      {"the foot of the other leg", &Roles::right_foot, whole.roles.left_foot},
  };
  for (const auto& c : cases) {
    Skeleton skeleton = whole;
    skeleton.roles.*c.role = c.bone;
    for (const Leg& leg : find_legs(Kinematics(skeleton), {gait_clip({1.2, 0, 0})})) {
      EXPECT_FALSE(leg.exists()) << c.label;
      EXPECT_EQ(leg.hinge, Leg().hinge) << c.label;
    }
  }
}

TEST(Leg, HasNoToeThatDoesNotHangFromItsFoot) {
  const Skeleton whole = humanoid();
  for (const int bone : {0, whole.roles.left_foot, whole.roles.left_thigh, whole.roles.right_toe, whole.roles.head}) {
    Skeleton skeleton = whole;
    skeleton.roles.left_toe = bone;
    const Legs legs = resting_legs(skeleton);
    ASSERT_TRUE(legs[0].exists());
    EXPECT_EQ(legs[0].toe, -1) << bone;
    EXPECT_EQ(legs[1].toe, whole.roles.right_toe);
  }
}

TEST(Leg, HasABoneThatCarriesBothLegsForNoThigh) {
  Skeleton skeleton = humanoid();
  const int carrier = skeleton.size();
  for (const char* name : {"carrier", "leg.L", "foot2.L", "leg.R", "foot2.R"}) skeleton.names.emplace_back(name);
  skeleton.parents.insert(skeleton.parents.end(), {0, carrier, carrier + 1, carrier, carrier + 3});
  skeleton.rest_rotations.resize(carrier + 5, Quaternion::Identity());
  skeleton.offsets.resize(carrier + 5, Vector3{0.1, 0, -0.3});
  skeleton.tips.resize(carrier + 5, Vector3{0, 0, -0.1});
  Roles& roles = skeleton.roles;
  roles.left_thigh = roles.right_thigh = carrier;
  roles.left_foot = carrier + 2;
  roles.right_foot = carrier + 4;
  for (const Leg& leg : find_legs(Kinematics(skeleton), {})) EXPECT_FALSE(leg.exists());
}

TEST(Leg, HasAUnitHingeWhereTheThighsAreInOnePlace) {
  Skeleton skeleton = humanoid();
  skeleton.offsets[skeleton.roles.left_thigh] = skeleton.offsets[skeleton.roles.right_thigh];
  for (const Leg& leg : find_legs(Kinematics(skeleton), {})) {
    ASSERT_TRUE(leg.exists());
    EXPECT_NEAR(leg.hinge.norm(), 1, 1e-12);
  }
}

TEST(Leg, EndsAtTheTipOfAShinThatIsItsFoot) {
  const Skeleton skeleton = on_shins();
  for (const Leg& leg : resting_legs(skeleton)) {
    ASSERT_TRUE(leg.exists());
    EXPECT_FALSE(leg.has_foot());
    EXPECT_EQ(leg.knee, leg.foot);
    EXPECT_EQ(leg.ankle, skeleton.tips[leg.foot]);
  }
  Skeleton stumps = skeleton;
  stumps.tips[stumps.roles.left_foot] *= 1e-6;
  EXPECT_FALSE(resting_legs(stumps)[0].exists());
}

TEST(Reach, StaysANumberWhereALegIsFoldedUpFlat) {
  Skeleton skeleton = humanoid();
  for (const char* bone : {"shin.L", "foot.L"}) skeleton.offsets[skeleton.find(bone)] = {0, 0, -0.43};
  const Kinematics kinematics(skeleton);
  const Leg leg = find_legs(kinematics, {})[0];
  PosedBones posed(skeleton.size());
  std::vector<double> rest;
  for (int b = 0; b < skeleton.size(); ++b) rest.insert(rest.end(), {1, 0, 0, 0});
  for (int n = -200; n <= 200; ++n) {
    std::vector<double> rotations = rest;
    const Quaternion bend{Eigen::AngleAxisd(kPi + 1e-9 * n, leg.hinge)};
    store_quaternion(bend, &rotations[std::size_t{4} * leg.knee]);
    kinematics.world({0, 0, 1}, rotations.data(), posed.heads.data(), posed.rotations.data());
    reach(skeleton, leg, posed, posed.heads[leg.foot], rotations.data());
    for (const double value : rotations) ASSERT_TRUE(std::isfinite(value)) << n;
  }
}

void bring_the_foot_there(const Skeleton& skeleton) {
  const Kinematics kinematics(skeleton);
  const Clip clip = gait_clip({1.2, 0, 0});
  const Legs legs = find_legs(kinematics, {clip});
  Random random(5);
  for (int n = 0; n < 200; ++n) {
    const Leg& leg = legs[n % 2];
    const int f = random.below(clip.frames);
    PosedBones posed(skeleton.size()), after(skeleton.size());
    world(kinematics, clip, f, posed.heads.data(), posed.rotations.data());
    const Vector3 foot = ankle_of(leg, posed), hip = posed.heads[leg.thigh];
    const Vector3 wanted = hip + (0.7 + 0.2 * random.uniform()) * (foot - hip) +
                           0.1 * Vector3{random.uniform() - 0.5, random.uniform() - 0.5, random.uniform() - 0.5};
    const auto begin = clip.rotations.begin() + std::ptrdiff_t{4} * skeleton.size() * f;
    std::vector<double> rotations(begin, begin + std::ptrdiff_t{4} * skeleton.size());
    reach(skeleton, leg, posed, wanted, rotations.data());
    kinematics.world(load_vector(&clip.root_positions[3 * f]), rotations.data(), after.heads.data(),
                     after.rotations.data());
    EXPECT_LT((ankle_of(leg, after) - wanted).norm(), 1e-6) << n;
    const double turned = std::abs(after.rotations[leg.foot].dot(posed.rotations[leg.foot]));
    EXPECT_TRUE(!leg.has_foot() || turned > 1 - 1e-9) << n;
    EXPECT_LT((after.heads[leg.thigh] - hip).norm(), 1e-12);
  }
}

TEST(Reach, BringsTheFootThereAndLeavesItsRotation) { bring_the_foot_there(humanoid()); }
TEST(Reach, BringsTheEndOfALegWithoutAFootThere) { bring_the_foot_there(on_shins()); }

// Both legs of a pose at once, and one after the other, to places near their ankles and far away.
void reach_with_both(const Skeleton& skeleton) {
  const Kinematics kinematics(skeleton);
  const Clip clip = gait_clip({1.2, 0, 0});
  const Legs legs = find_legs(kinematics, {clip});
  Random random(7);
  for (int n = 0; n < 200; ++n) {
    PosedBones posed(skeleton.size());
    const int f = random.below(clip.frames);
    world(kinematics, clip, f, posed.heads.data(), posed.rotations.data());
    std::array<Vector3, 2> ankles;
    for (int side = 0; side < 2; ++side) {
      const Vector3 way{random.uniform() - 0.5, random.uniform() - 0.5, random.uniform() - 0.5};
      ankles[side] = ankle_of(legs[side], posed) + (n % 3 == 0 ? 2 : 0.2) * way;
    }
    const auto begin = clip.rotations.begin() + std::ptrdiff_t{4} * skeleton.size() * f;
    std::vector<double> together(begin, begin + std::ptrdiff_t{4} * skeleton.size()), apart = together;
    const Reach within[] = {{0.3, 0.7}, {0.4, 0.8}};
    const bool bounded = n % 2 == 0;
    reach(skeleton, {&legs[0], &legs[1]}, posed, ankles, together.data(), bounded ? within : nullptr);
    EXPECT_NE(together, apart);
    for (int side = 0; side < 2; ++side) {
      if (bounded) {
        reach(skeleton, legs[side], posed, ankles[side], within[side], apart.data());
      } else {
        reach(skeleton, legs[side], posed, ankles[side], apart.data());
      }
    }
    EXPECT_EQ(together, apart) << n;
  }
}

TEST(Reach, DoesWithTwoLegsWhatItDoesWithEach) {
  reach_with_both(humanoid());
  reach_with_both(on_shins());
}

// A standing leg whose knee is bent further by an angle, before it reaches for where its foot is, and after.
struct BentLeg {
  Skeleton skeleton = humanoid();
  Kinematics kinematics{skeleton};
  Clip clip = gait_clip({0, 0, 0});
  Leg leg = find_legs(kinematics, {gait_clip({1.2, 0, 0})})[0];
  PosedBones posed{skeleton.size()}, after{skeleton.size()};

  void bend(double angle) {
    std::vector<double> rotations(clip.rotations.begin(), clip.rotations.begin() + std::ptrdiff_t{4} * skeleton.size());
    const Quaternion bend{Eigen::AngleAxisd(angle, leg.hinge)};
    store_quaternion(bend * load_quaternion(&rotations[4 * leg.knee]), &rotations[4 * leg.knee]);
    const Vector3 root = load_vector(clip.root_positions.data());
    kinematics.world(root, rotations.data(), posed.heads.data(), posed.rotations.data());
    reach(skeleton, leg, posed, posed.heads[leg.foot], rotations.data());
    kinematics.world(root, rotations.data(), after.heads.data(), after.rotations.data());
  }
};

TEST(Reach, NeverBendsAKneeBackwardNorSnapsIt) {
  BentLeg bent;
  const Leg& leg = bent.leg;
  Vector3 before = Vector3::Zero();
  for (int n = 0; n <= 60; ++n) {
    bent.bend(0.3 - 0.01 * n);  // from forward to as far backward
    const std::vector<Vector3>& heads = bent.after.heads;
    const Vector3 hip = heads[leg.thigh], knee = heads[leg.knee], foot = heads[leg.foot];
    EXPECT_GE((bent.after.rotations[leg.thigh] * leg.hinge).dot((knee - hip).cross(foot - knee)), 0) << n;
    EXPECT_LT((foot - bent.posed.heads[leg.foot]).norm(), 0.03) << n;
    if (n > 0) {
      EXPECT_LT((knee - before).norm(), 0.01) << n;
    }
    before = knee;
  }
}

TEST(Reach, NeitherFoldsUpAKneeNorSnapsItWhereAStitchOvershoots) {
  BentLeg bent;
  for (int n = 0; n <= 100; ++n) {
    bent.bend(2.3 + 0.01 * n);  // from bent to folded further than flat
    const Vector3 hip = bent.after.heads[bent.leg.thigh], foot = bent.after.heads[bent.leg.foot];
    EXPECT_GT((foot - hip).norm(), 0.2) << n;
    EXPECT_LT((foot - hip).norm(), 0.4) << n;
  }
}

TEST(Reach, FoldsALegUpNoFurtherThanItReaches) {
  for (const double size : {1.0, 0.1, 0.01, 2.5e-3}) {  // of the lower leg: down to hardly one
    Skeleton skeleton = humanoid();
    skeleton.offsets[skeleton.roles.left_foot] *= size;
    const Kinematics kinematics(skeleton);
    const Clip clip = gait_clip({1.2, 0, 0});
    const Leg leg = find_legs(kinematics, {clip})[0];
    ASSERT_TRUE(leg.exists()) << size;
    PosedBones posed(skeleton.size());
    for (int f = 0; f < clip.frames; ++f) {
      world(kinematics, clip, f, posed.heads.data(), posed.rotations.data());
      EXPECT_LE(shortest(leg, posed), longest(leg, posed)) << size << " " << f;
    }
  }
}

TEST(Reach, ComesAsNearAsTheLegIsLong) {
  const Skeleton skeleton = humanoid();
  const Kinematics kinematics(skeleton);
  const Clip clip = gait_clip({1.2, 0, 0});
  const Leg leg = find_legs(kinematics, {clip})[0];
  PosedBones posed(skeleton.size()), after(skeleton.size());
  world(kinematics, clip, 0, posed.heads.data(), posed.rotations.data());
  std::vector<double> rotations(clip.rotations.begin(), clip.rotations.begin() + std::ptrdiff_t{4} * skeleton.size());
  const Vector3 far = posed.heads[leg.thigh] + Vector3{0.3, 2, -1};
  reach(skeleton, leg, posed, far, rotations.data());
  kinematics.world(load_vector(clip.root_positions.data()), rotations.data(), after.heads.data(),
                   after.rotations.data());
  const Vector3 leg_now = after.heads[leg.foot] - after.heads[leg.thigh], way = far - after.heads[leg.thigh];
  EXPECT_LT(leg_now.cross(way).norm(), 1e-6 * way.norm());
  EXPECT_GT(leg_now.dot(way), 0);
}

}  // namespace
}  // namespace fragmotion

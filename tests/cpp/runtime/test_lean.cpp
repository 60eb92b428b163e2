// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "runtime/lean.hpp"
#include "skeleton/two_bone_ik.hpp"
#include "steering.hpp"
#include "walker.hpp"

namespace fragmotion {
namespace {

// A standing body, turned by a heading, that is accelerated.
struct LeaningBody {
  Skeleton skeleton = humanoid();
  Kinematics kinematics{skeleton};
  Lean lean{Trunk(skeleton), resting_legs(skeleton), 1};
  int chest = Trunk(skeleton).chest;
  Clip clip = gait_clip({0, 0, 0});
  double heading = 0;

  LeaningBody() {
    Gait gait{0, 0, 0};
    gait.heading = heading = 0.8;
    clip = gait_clip(gait);
  }

  // Seen from the character frame, m.
  struct Seen {
    Vector3 hips, head, foot;
    Quaternion chest;
  };

  // As it is after an acceleration for a while.
  Seen after(const Vector2& acceleration, double seconds) {
    Seen seen;
    for (double t = 0; t < seconds; t += kStep) {
      WorldPose pose{load_vector(clip.root_positions.data()), clip.headings[0], {}};
      pose.rotations.assign(clip.rotations.begin(), clip.rotations.begin() + std::ptrdiff_t{4} * skeleton.size());
      lean.apply(skeleton, pose, acceleration, PlaneTurn(pose.heading), filtered(kStep, LeanConstants{}.follows));
      PosedBones posed(skeleton.size());
      kinematics.world(pose.root, pose.rotations.data(), posed.heads.data(), posed.rotations.data());
      const CharacterFrame frame{pose.root.head<2>(), pose.heading};
      const Eigen::Quaterniond back{frame.rotation().inverse()};
      const auto place = [&](int bone) { return Vector3{back * (posed.heads[bone] - pose.root)}; };
      seen = {place(skeleton.roles.hips), place(skeleton.roles.head), place(skeleton.roles.left_foot),
              back * posed.rotations[chest]};
    }
    return seen;
  }
};

TEST(Lean, LeansTheTrunkIntoTheAccelerationByHalfOfWhatBalancesIt) {
  LeaningBody body;
  const auto upright = body.after({0, 0}, 0.5);
  const double hip_joint = body.skeleton.offsets[resting_legs(body.skeleton)[0].thigh].norm();
  for (const double angle : {0.0, 1.0, 2.5, -2.0}) {
    const Vector2 acceleration = 4 * Vector2{std::cos(angle), std::sin(angle)};
    const auto leaning = body.after(acceleration, 2);
    const Eigen::AngleAxisd lean{leaning.chest * upright.chest.conjugate()};
    EXPECT_GT(lean.axis().dot(Vector3{-acceleration.y(), acceleration.x(), 0}.normalized()), 0.99);
    EXPECT_NEAR(lean.angle(), 0.5 * std::atan(4 / 9.81), 0.01);
    EXPECT_LT((leaning.hips - upright.hips).norm(), 1e-9);
    EXPECT_LT((leaning.foot - upright.foot).norm(), lean.angle() * hip_joint);
  }
}

// Bone by bone, each as it finds the pose.
TEST(Lean, TurnsThighsHipsSpineAndHeadAsTheyAreTurnedOneAfterAnother) {
  LeaningBody body;
  const Skeleton& skeleton = body.skeleton;
  const Trunk trunk(skeleton);
  ASSERT_GE(trunk.head, 0);
  const Vector2 acceleration{3, -4};
  for (int step = 0; step < 300; ++step) body.after(acceleration, kStep);
  WorldPose pose{load_vector(body.clip.root_positions.data()), body.clip.headings[0], {}};
  pose.rotations.assign(body.clip.rotations.begin(), body.clip.rotations.begin() + std::ptrdiff_t{4} * skeleton.size());
  std::vector<double> expected = pose.rotations;
  body.lean.apply(skeleton, pose, acceleration, PlaneTurn(pose.heading), filtered(kStep, LeanConstants{}.follows));
  const double angle = 0.5 * std::atan(5 / 9.81);
  const Vector3 right{std::cos(pose.heading), std::sin(pose.heading), 0}, forward{-right.y(), right.x(), 0};
  const double to_side = angle * acceleration.x() / 5, to_front = angle * acceleration.y() / 5;
  const Legs legs = resting_legs(skeleton);
  for (const int thigh : {legs[0].thigh, legs[1].thigh}) turn_bone(skeleton, thigh, right, to_front, expected.data());
  turn_bone(skeleton, skeleton.roles.hips, right, -to_front, expected.data());
  turn_bone(skeleton, trunk.head, right, kHeadBack * to_front, expected.data());
  turn_spine(skeleton, trunk, forward, to_side, expected.data());
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(pose.rotations[i], expected[i], 1e-6) << i;
}

TEST(Lean, ComesAndGoesSmoothly) {
  LeaningBody body;
  Vector3 before = body.after({0, 0}, kStep).head;
  const auto steps = [&](const Vector2& acceleration) {
    for (int f = 0; f < 60; ++f) {
      const Vector3 now = body.after(acceleration, kStep / 2).head;
      EXPECT_LT((now - before).norm(), 0.02) << f;  // 1.2 m/s
      before = now;
    }
  };
  const Vector3 upright = before;
  steps({0, 500});  // no body is accelerated like that
  EXPECT_GT(before.y() - upright.y(), 0.08);
  steps({0, 0});
  EXPECT_LT((before - upright).norm(), 1e-3);
}

TEST(Lean, TurnsTheTrunkNoFasterThanPeopleDoWhereAPushIsReversed) {
  constexpr double kFastest = 1.6;  // rad/s
  LeaningBody body;
  Quaternion before = body.after({0, 4.8}, 2).chest;
  double fastest = 0;
  for (int f = 0; f < 60; ++f) {
    const Quaternion now = body.after({0, -4.8}, kStep / 2).chest;
    fastest = std::max(fastest, now.angularDistance(before) / kStep);
    before = now;
  }
  EXPECT_LT(fastest, kFastest);
  EXPECT_GT(fastest, 0.5 * kFastest);
}

TEST(Lean, LeavesASkeletonWithoutASpineAsItIs) {
  LeaningBody body;
  body.skeleton.roles.left_hand = body.skeleton.roles.right_hand = -1;
  body.lean = Lean(Trunk(body.skeleton), resting_legs(body.skeleton), 1);
  const auto upright = body.after({0, 0}, 0.5), leaning = body.after({0, 5}, 1);
  EXPECT_EQ(upright.head, leaning.head);
  EXPECT_EQ(upright.foot, leaning.foot);
  EXPECT_EQ(upright.chest.coeffs(), leaning.chest.coeffs());
}

}  // namespace
}  // namespace fragmotion

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
  Lean lean{Trunk(skeleton), 1};
  Clip clip = gait_clip({0, 0, 0});
  double heading = 0;

  LeaningBody() {
    Gait gait{0, 0, 0};
    gait.heading = heading = 0.8;
    clip = gait_clip(gait);
  }

  // The heads of hips, chest, head and left foot, seen from the character frame, after an acceleration for a while.
  std::array<Vector3, 4> after(const Vector2& acceleration, double seconds) {
    std::array<Vector3, 4> heads;
    for (double t = 0; t < seconds; t += kStep) {
      WorldPose pose{load_vector(clip.root_positions.data()), clip.headings[0], {}};
      pose.rotations.assign(clip.rotations.begin(), clip.rotations.begin() + std::ptrdiff_t{4} * skeleton.size());
      lean.apply(skeleton, pose, acceleration, kStep);
      PosedBones posed(skeleton.size());
      kinematics.world(pose.root, pose.rotations.data(), posed.heads.data(), posed.rotations.data());
      const CharacterFrame frame{pose.root.head<2>(), pose.heading};
      const int bones[] = {skeleton.roles.hips, 1, skeleton.roles.head, skeleton.roles.left_foot};
      for (int i = 0; i < 4; ++i) heads[i] = frame.rotation().inverse() * (posed.heads[bones[i]] - pose.root);
    }
    return heads;
  }
};

TEST(Lean, LeansTheTrunkIntoTheAccelerationByHalfOfWhatBalancesIt) {
  LeaningBody body;
  const auto upright = body.after({0, 0}, 0.5);
  for (const double angle : {0.0, 1.0, 2.5, -2.0}) {
    const Vector2 acceleration = 4 * Vector2{std::cos(angle), std::sin(angle)};
    const auto leaning = body.after(acceleration, 2);
    const Vector2 goes = (leaning[2] - upright[2]).head<2>();
    EXPECT_GT(goes.dot(acceleration.normalized()), 0.99 * goes.norm());
    const double spine = (upright[2] - upright[1]).norm();
    EXPECT_NEAR(goes.norm() / spine, std::sin(0.5 * std::atan(4 / 9.81)), 0.03);
    for (const int still : {0, 3}) EXPECT_LT((leaning[still] - upright[still]).norm(), 1e-9);
  }
}

TEST(Lean, ComesAndGoesSmoothly) {
  LeaningBody body;
  Vector3 before = body.after({0, 0}, kStep)[2];
  const auto steps = [&](const Vector2& acceleration) {
    for (int f = 0; f < 60; ++f) {
      const Vector3 now = body.after(acceleration, kStep / 2)[2];
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
  const auto upright = body.after({0, 0}, kStep);
  const double spine = (upright[2] - upright[1]).norm();
  Vector3 before = body.after({0, 4.8}, 2)[2];
  double fastest = 0;
  for (int f = 0; f < 60; ++f) {
    const Vector3 now = body.after({0, -4.8}, kStep / 2)[2];
    fastest = std::max(fastest, (now - before).norm() / spine / kStep);
    before = now;
  }
  EXPECT_LT(fastest, kFastest);
  EXPECT_GT(fastest, 0.5 * kFastest);
}

TEST(Lean, LeavesASkeletonWithoutASpineAsItIs) {
  LeaningBody body;
  body.skeleton.roles.left_hand = body.skeleton.roles.right_hand = -1;
  body.lean = Lean(Trunk(body.skeleton), 1);
  const auto upright = body.after({0, 0}, 0.5), leaning = body.after({0, 5}, 1);
  for (int i = 0; i < 4; ++i) EXPECT_EQ(upright[i], leaning[i]);
}

}  // namespace
}  // namespace fragmotion

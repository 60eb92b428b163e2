// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "fragmotion/runtime/breathing.hpp"
#include "fragmotion/skeleton/two_bone_ik.hpp"
#include "steering.hpp"
#include "walker.hpp"

namespace fragmotion {
namespace {

// Heads of all bones while a body stands and breathes, or does not.
struct BreathingBody {
  Skeleton skeleton = humanoid();
  Kinematics kinematics{skeleton};
  Breathing breathing{Trunk(skeleton)};
  Clip clip = gait_clip({0, 0, 0});

  PosedBones shown(bool stands) {
    WorldPose pose{load_vector(clip.root_positions.data()), clip.headings[0], {}};
    pose.rotations.assign(clip.rotations.begin(), clip.rotations.begin() + std::ptrdiff_t{4} * skeleton.size());
    breathing.apply(skeleton, pose, stands, kStep);
    PosedBones posed(skeleton.size());
    kinematics.world(pose.root, pose.rotations.data(), posed.heads.data(), posed.rotations.data());
    return posed;
  }
};

TEST(Breathing, MovesTheHandsALittleSmoothlyAndNeverTheFeet) {
  BreathingBody body;
  const Roles& roles = body.skeleton.roles;
  const PosedBones still = body.shown(false);
  PosedBones before = still;
  double most = 0;
  for (int f = 0; f < 600; ++f) {
    const PosedBones now = body.shown(true);
    EXPECT_EQ(now.heads[roles.left_foot], still.heads[roles.left_foot]);
    EXPECT_EQ(now.heads[roles.hips], still.heads[roles.hips]);
    EXPECT_LT((now.heads[roles.left_hand] - before.heads[roles.left_hand]).norm(), 1e-3);
    most = std::max(most, (now.heads[roles.left_hand] - still.heads[roles.left_hand]).norm());
    EXPECT_LT(now.rotations[roles.head].angularDistance(still.rotations[roles.head]), 0.01);
    before = now;
  }
  EXPECT_GT(most, 0);
}

TEST(Breathing, FadesWhereTheBodyGoes) {
  BreathingBody body;
  const Roles& roles = body.skeleton.roles;
  const PosedBones still = body.shown(false);
  for (int f = 0; f < 100; ++f) body.shown(true);
  for (int f = 0; f < 300; ++f) body.shown(false);
  EXPECT_EQ(body.shown(false).heads[roles.left_hand], still.heads[roles.left_hand]);
}

TEST(Breathing, LeavesASkeletonWithoutArmsAsItIs) {
  BreathingBody body;
  body.skeleton.roles.left_hand = -1;
  body.breathing = Breathing(Trunk(body.skeleton));
  const PosedBones still = body.shown(false);
  for (int f = 0; f < 100; ++f) EXPECT_EQ(body.shown(true).heads, still.heads);
}

}  // namespace
}  // namespace fragmotion

// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "runtime/look_stitch.hpp"
#include "small_character.hpp"

namespace fragmotion {
namespace {

constexpr double kBetween = 1.0 / 60, kStitched = 0.2, kFastest = 3;  // s, s, rad/s

// A stitch to a pose of a clip from one whose trunk and head were turned to either side.
struct Stitched {
  std::shared_ptr<const Character> character = gait_character();
  mutable Workspace workspace{*character};
  const PackedClip& clip = character->pool.clips[0];
  LookStitch look{workspace};
  Inertialization body{workspace.kinematics.bones()};
  int head = workspace.kinematics.skeleton().roles.head;
  WorldPose fresh, old;

  explicit Stitched(double turning = 0) {
    std::fill(workspace.fastest_looks.begin(), workspace.fastest_looks.end(), static_cast<float>(kFastest));
    fresh.rotations.resize(std::size_t{4} * workspace.kinematics.bones());
    fresh.root = sample_pose(clip, 0, fresh.rotations.data());
    old = fresh;
    turn(old, workspace.kinematics.skeleton().parents[workspace.look.front()], -0.3);
    turn(old, head, 0.9);
    body.begin(old, old, fresh, fresh, kBetween, kStitched, &clip);
    look.begin(old, old, fresh, fresh, kBetween, kStitched, turning, clip, body);
  }

  static void turn(WorldPose& pose, int bone, double angle) {
    double* rotation = &pose.rotations[std::size_t{4} * bone];
    store_quaternion(Quaternion{Eigen::AngleAxisd(angle, Vector3::UnitZ())} * load_quaternion(rotation), rotation);
  }

  WorldPose body_alone(double time) const {
    WorldPose pose = fresh;
    workspace.unpacked.sample(clip, 0, {-1, {1, 0}, body.turns(body.left(time))}, pose.rotations.data());
    return pose;
  }

  WorldPose shown(double time) const {
    WorldPose pose = body_alone(time);
    look.apply(time, body, clip, pose);
    return pose;
  }

  // How the head is turned in the world.
  Quaternion seen(const WorldPose& pose) const {
    Quaternion world = Quaternion::Identity();
    for (int b = head; b >= 0; b = workspace.kinematics.skeleton().parents[b]) {
      world = load_quaternion(&pose.rotations[std::size_t{4} * b]) * world;
    }
    return world;
  }

  double fastest() const {
    double most = 0;
    for (double time = 0; time < 4; time += 0.01) {
      most = std::max(most, seen(shown(time)).angularDistance(seen(shown(time + 0.01))) / 0.01);
    }
    return most;
  }
};

TEST(LookStitch, BeginsWithTheOldPoseAndEndsWithTheNewOne) {
  const Stitched stitch;
  for (std::size_t i = 0; i < stitch.old.rotations.size(); ++i) {
    EXPECT_NEAR(stitch.shown(0).rotations[i], stitch.old.rotations[i], 1e-6);
    EXPECT_NEAR(stitch.shown(4).rotations[i], stitch.fresh.rotations[i], 1e-6);
  }
}

TEST(LookStitch, TurnsTheHeadNoFasterThanHeadsDoWhileTheBodyIsThereSooner) {
  const Stitched stitch;
  EXPECT_LT(stitch.fastest(), (kTurnsAtMost - 1) * kFastest * 1.01);
  EXPECT_GT(stitch.fastest(), (kTurnsAtMost - 1) * kFastest * 0.9);
  const int below = stitch.workspace.kinematics.skeleton().parents[stitch.workspace.look.front()];
  for (int i = 0; i < 4; ++i) {
    EXPECT_EQ(stitch.shown(kStitched).rotations[4 * below + i], stitch.body_alone(kStitched).rotations[4 * below + i]);
  }
}

TEST(LookStitch, TakesLongestWhereTheBodyItselfIsTurnedAsFast) {
  const Stitched stitch(kFastest);
  EXPECT_LT(stitch.fastest(), 0.9 * Stitched().fastest());
  for (double time = 0; time < 4 * kSlowestStitch; time += 0.1) {
    EXPECT_GE(stitch.seen(stitch.shown(time)).angularDistance(stitch.seen(stitch.fresh)) + 1e-3,
              Stitched().seen(Stitched().shown(time)).angularDistance(stitch.seen(stitch.fresh)));
  }
}

}  // namespace
}  // namespace fragmotion

// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "skeleton/kinematics.hpp"
#include "small_skeleton.hpp"

namespace fragmotion {
namespace {

Quaternion about_z(double angle) { return Quaternion{Eigen::AngleAxisd(angle, Vector3::UnitZ())}; }

struct World {
  std::vector<Vector3> heads;
  std::vector<Quaternion> rotations;
};

World world(const Kinematics& kinematics, const Vector3& root, const std::vector<double>& rotations) {
  World out{std::vector<Vector3>(kinematics.bones()), std::vector<Quaternion>(kinematics.bones())};
  kinematics.world(root, rotations.data(), out.heads.data(), out.rotations.data());
  return out;
}

TEST(CharacterFrame, IsXRightYForwardZUp) {
  const CharacterFrame left{{1, 2}, kPi / 2};  // faces -x
  EXPECT_LT((left.to_world({0, 1, 0}) - Vector3(0, 2, 0)).norm(), 1e-15);
  EXPECT_LT((left.to_world({1, 0, 5}) - Vector3(1, 3, 5)).norm(), 1e-15);
}

TEST(CharacterFrame, ToLocalInvertsToWorld) {
  Random random(1);
  for (int n = 0; n < 100; ++n) {
    const CharacterFrame frame{random_vector(random, 9).head<2>(), 7 * random.uniform() - 3};
    const Vector3 point = random_vector(random, 5);
    EXPECT_LT((frame.to_local(frame.to_world(point)) - point).norm(), 1e-13);
    EXPECT_LT((frame.rotation() * point - (frame.to_world(point) - frame.to_world(Vector3::Zero()))).norm(), 1e-13);
  }
}

TEST(Kinematics, RestingCharacterOfBlenderFacesBackwards) {
  const Kinematics kinematics(small_skeleton());
  EXPECT_EQ(kinematics.rest_frame().position, Vector2(0, 0));
  EXPECT_DOUBLE_EQ(std::abs(kinematics.rest_frame().heading), kPi);
}

TEST(Kinematics, FacingIsAcrossTheThighs) {
  Skeleton skeleton = small_skeleton();
  skeleton.offsets[3] = {0, 0.1, 0};  // left at +y: faces +x
  skeleton.offsets[5] = {0, -0.1, 0};
  const Kinematics kinematics(skeleton);
  EXPECT_DOUBLE_EQ(kinematics.rest_frame().heading, -kPi / 2);
  EXPECT_LT((kinematics.rest_frame().to_world({0, 1, 0}) - Vector3(1, 0, 0)).norm(), 1e-15);
}

TEST(Kinematics, WithoutThighsFacesAsBlenderDoes) {
  Skeleton skeleton = small_skeleton();
  skeleton.roles.left_thigh = -1;
  skeleton.rest_rotations[2] = Quaternion{Eigen::AngleAxisd(1, Vector3(1, 2, 3).normalized())};
  const Kinematics kinematics(skeleton);
  EXPECT_NEAR(std::abs(kinematics.rest_frame().heading), kPi, 1e-12);
}

TEST(Kinematics, HeadingOfHipsWithoutGroundLineIsZero) {
  const Kinematics kinematics(small_skeleton());
  const Quaternion on_the_side{Eigen::AngleAxisd(kPi / 2, Vector3::UnitY())};
  EXPECT_EQ(kinematics.frame({3, 4, 1}, on_the_side).heading, 0);
  EXPECT_EQ(kinematics.frame({3, 4, 1}, on_the_side).position, Vector2(3, 4));
}

TEST(Kinematics, HeadingTurnsLeftWithTheHips) {
  const Kinematics kinematics(small_skeleton());
  for (const double turn : {-3.0, -1.0, 0.5, 2.0}) {
    const double heading = kinematics.frame({0, 0, 1}, about_z(kPi + turn)).heading;
    EXPECT_NEAR(heading, turn, 1e-12);
  }
}

TEST(Kinematics, PosesAFrameOfAClip) {
  const Skeleton skeleton = small_skeleton();
  const Kinematics kinematics(skeleton);
  const Clip clip = make_clip(skeleton, random_clip(skeleton, 3, 4));
  World found{std::vector<Vector3>(8), std::vector<Quaternion>(8)};
  world(kinematics, clip, 2, found.heads.data(), found.rotations.data());
  const std::vector<double> pose(clip.rotations.begin() + 2 * 32, clip.rotations.end());
  const World expected = world(kinematics, load_vector(&clip.root_positions[6]), pose);
  for (int b = 0; b < 8; ++b) {
    EXPECT_EQ(found.heads[b], expected.heads[b]);
    EXPECT_EQ(found.rotations[b].coeffs(), expected.rotations[b].coeffs());
  }
}

TEST(Kinematics, RestPoseStaysWhereItRests) {
  const Skeleton skeleton = small_skeleton();
  std::vector<Vector3> heads;
  std::vector<Quaternion> rotations;
  rest_pose(skeleton, heads, rotations);
  std::vector<double> pose(4 * skeleton.size(), 0);
  for (int b = 0; b < skeleton.size(); ++b) pose[4 * b] = 1;
  const World rest = world(Kinematics(skeleton), heads[skeleton.roles.hips], pose);
  for (int b = 0; b < skeleton.size(); ++b) {
    EXPECT_LT((rest.heads[b] - heads[b]).norm(), 1e-12) << skeleton.names[b];
    EXPECT_LT(rest.rotations[b].angularDistance(rotations[b]), 1e-12) << skeleton.names[b];
  }
}

TEST(Kinematics, BendsALegAsComputedByHand) {
  const Skeleton skeleton = small_skeleton();
  std::vector<double> pose(4 * skeleton.size(), 0);
  for (int b = 0; b < skeleton.size(); ++b) pose[4 * b] = 1;
  // The left thigh turns by 90 degrees about x: z becomes -y, so the foot at (0, .02, -.4) comes to (0, .4, .02).
  store_quaternion(Quaternion{Eigen::AngleAxisd(kPi / 2, Vector3::UnitX())}, &pose[4 * 3]);
  const World bent = world(Kinematics(skeleton), {5, 6, 1}, pose);
  EXPECT_LT((bent.heads[4] - Vector3(5.1, 6.4, 0.97)).norm(), 1e-12);
  EXPECT_LT((bent.heads[6] - Vector3(4.9, 6.02, 0.55)).norm(), 1e-12);
  EXPECT_LT((bent.heads[0] - Vector3(5, 6, 0)).norm(), 1e-12);    // carried: stays on the ground below the hips
  EXPECT_LT((bent.heads[1] - Vector3(6, 8, 0.5)).norm(), 1e-12);  // carried: beside the hips' ancestor
}

TEST(Kinematics, MovesWithTheGround) {
  const Skeleton skeleton = small_skeleton();
  const Kinematics kinematics(skeleton);
  Random random(8);
  for (int n = 0; n < 20; ++n) {
    std::vector<double> pose = random_clip(skeleton, 2, n).rotations;
    const Vector3 root = random_vector(random, 3);
    const World before = world(kinematics, root, pose);
    const CharacterFrame move{random_vector(random, 5).head<2>(), 6 * random.uniform() - 3};
    double* hips = &pose[4 * skeleton.roles.hips];
    store_quaternion(move.rotation() * load_quaternion(hips), hips);
    const World after = world(kinematics, move.to_world(root), pose);
    for (int b = 0; b < skeleton.size(); ++b) {
      EXPECT_LT((after.heads[b] - move.to_world(before.heads[b])).norm(), 1e-12) << skeleton.names[b];
      EXPECT_LT(after.rotations[b].angularDistance(move.rotation() * before.rotations[b]), 1e-12) << skeleton.names[b];
    }
  }
}

}  // namespace
}  // namespace fragmotion

// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "io/hanging.hpp"
#include "io/rig.hpp"
#include "posed_frames.hpp"

namespace fragmotion {
namespace {

// root > hips > thigh > shin, and root > {foot > toe, pole}: the foot is where the shin ends, the pole before the knee.
const std::vector<int> kParents = {-1, 0, 1, 2, 0, 4, 0};
const std::vector<std::string> kNames = {"root", "hips", "thigh.L", "shin.L", "foot.L", "toe.L", "pole.L"};

// A leg that swings by `angle` from its hips.
std::vector<double> leg_pose(double angle) {
  const Frame thigh = at(0, 1, angle), shin = thigh * at(0, -0.5, -angle / 2), foot = shin * at(0, -0.4);
  std::vector<double> values;
  for (const Frame& frame : {at(0, 0), at(0, 1), thigh, shin, foot, foot * at(-0.1, 0), at(-0.5, 0.5 + angle / 9)})
    add_rows(frame, values);
  return values;
}

std::vector<double> swing() {
  std::vector<double> poses;
  for (int f = 0; f < 12; ++f) {
    const std::vector<double> each = leg_pose(0.6 * std::sin(f));
    poses.insert(poses.end(), each.begin(), each.end());
  }
  return poses;
}

TEST(Hanging, SpansWhatABoneGoesAsAnotherSeesIt) {
  const std::vector<double> poses = swing();
  EXPECT_NEAR(span_beside(poses.data(), 12, 7, 4, 3), 0, 1e-12) << "the foot is at the shin's end";
  EXPECT_NEAR(span_beside(poses.data(), 12, 7, 6, 1), span_beside(poses.data(), 12, 7, 6, 0), 1e-12);
  double least = 0, most = 0;
  for (int f = 0; f < 12; ++f) {
    least = std::min(least, 0.6 * std::sin(f));
    most = std::max(most, 0.6 * std::sin(f));
  }
  EXPECT_NEAR(span_beside(poses.data(), 12, 7, 6, 0), (most - least) / 9, 1e-12) << "the pole goes up and down";
}

TEST(Hanging, IsFoundOfAFootThatIsNoChildOfItsLeg) {
  const std::vector<double> poses = swing();
  const auto found = find_hanging(kNames, kParents, poses.data(), 12, {4, 6});
  EXPECT_EQ(found, (std::map<int, int>{{4, 3}}));
}

// As a leg whose IK does not reach, in most of a pack's Actions: these tell nothing, and hide nothing.
TEST(Hanging, IsFoundThoughTheFootIsOffItsPlaceWhereItStands) {
  std::vector<double> poses = swing();
  const std::vector<double> stands = leg_pose(0);
  for (int f = 0; f < 100; ++f) {
    poses.insert(poses.end(), stands.begin(), stands.end());
    poses[poses.size() - 3 * 16 + 7] += 0.05;  // y of the foot
  }
  EXPECT_EQ(find_hanging(kNames, kParents, poses.data(), 112, {4}), (std::map<int, int>{{4, 3}}));
}

// A trunk, two shoulders and a tail on one bone that stays behind, which all sway together, the tail a bit more.
TEST(Hanging, IsOnTheTrunkOfWhatGoesBesideIt) {
  const std::vector<std::string> names = {"root", "one", "two", "trunk", "tail"};
  const std::vector<int> parents = {-1, 0, 0, 0, 0};
  std::vector<double> poses;
  for (int f = 0; f < 12; ++f) {
    const Frame trunk = at(0, 1 + 0.1 * std::sin(f));
    const Frame one = trunk * at(0.3, 0, 0.6 * std::sin(f)), two = trunk * at(0.3, 0, 0.5 * std::cos(f));
    for (const Frame& frame : {at(0, 0), one, two, trunk, trunk * at(-0.3, 0)}) add_rows(frame, poses);
  }
  const std::map<int, int> on_trunk = {{1, 3}, {2, 3}, {4, 3}};
  EXPECT_EQ(find_hanging(names, parents, poses.data(), 12, {1, 2, 3, 4}), on_trunk);
  EXPECT_EQ(find_hanging(names, parents, poses.data(), 12, {1, 2, 4}), on_trunk);
}

TEST(Hanging, IsNeverOnABoneThatItMoves) {
  const std::vector<double> poses = swing();
  for (const auto& [bone, on] : find_hanging(kNames, kParents, poses.data(), 12, {1, 2, 3, 4, 5, 6}))
    EXPECT_TRUE(bone != 4 || on == 3) << bone << " on " << on;
}

// Each foot goes with another bone, if only by a little: they hang on each other's counterparts all the same.
TEST(Hanging, IsAlikeOnBothSides) {
  const std::vector<std::string> names = {"root", "shin.L", "heel.L", "shin.R", "heel.R", "foot.L", "foot.R"};
  const std::vector<int> parents = {-1, 0, 1, 0, 3, 0, 0};
  std::vector<double> poses;
  for (int f = 0; f < 12; ++f) {
    const Frame shin = at(0, 1, 0.6 * std::sin(f)), heel = shin * at(0, -0.5, 0.1 * std::cos(f));
    for (const Frame& frame : {at(0, 0), shin, heel, shin, heel, shin * at(0, -0.55), heel * at(0, -0.05)})
      add_rows(frame, poses);
  }
  const std::map<int, int> found = find_hanging(names, parents, poses.data(), 12, {5, 6});
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found.at(6), found.at(5) + 2);
}

Armature armature() {
  Armature armature;
  armature.names = kNames;
  armature.parents = kParents;
  armature.rest = leg_pose(0);
  armature.lengths.assign(kNames.size(), 0.1);
  add_rows(Frame::Identity(), armature.world);
  armature.roles = {{"hips", "hips"}};
  armature.hangs = {{"foot.L", "shin.L"}};
  return armature;
}

TEST(Rig, BringsAFootToWhereItsLegEnds) {
  const Rig rig(armature());
  const Skeleton& skeleton = rig.skeleton();
  EXPECT_EQ(skeleton.parents[skeleton.find("foot.L")], skeleton.find("shin.L"));
  EXPECT_EQ(skeleton.parents[skeleton.find("toe.L")], skeleton.find("foot.L"));
  const std::vector<double> poses = swing();
  const Clip clip = rig.clip_from_matrices("swing", 30, 12, poses.data());
  const Channels channels = rig.channels(12, clip.root_positions.data(), clip.rotations.data());
  for (int f = 0; f < 12; ++f) {  // at rest the foot is at (0, 0, 0.1) of a root that does not move
    const double* foot = &poses[16 * (f * kNames.size() + 4)];
    const Vector3 location = load_vector(&channels.locations[3 * (f * kNames.size() + 4)]);
    EXPECT_LT((location - Vector3(foot[3], foot[7], foot[11] - 0.1)).norm(), 1e-9) << f;
  }
  const Clip again = rig.clip("again", 30, 12, channels.locations.data(), channels.rotations.data());
  for (std::size_t i = 0; i < clip.rotations.size(); ++i) EXPECT_NEAR(again.rotations[i], clip.rotations[i], 1e-9);
}

TEST(Rig, RefusesABoneThatHangsOnWhatItMoves) {
  Armature wrong = armature();
  wrong.hangs = {{"foot.L", "toe.L"}};
  EXPECT_THROW(Rig{wrong}, std::invalid_argument);
  wrong.hangs = {{"foot.L", "shin.R"}};
  EXPECT_THROW(Rig{wrong}, std::invalid_argument);
}

}  // namespace
}  // namespace fragmotion

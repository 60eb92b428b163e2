// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "io/joints.hpp"
#include "posed_frames.hpp"

namespace fragmotion {
namespace {

// All hang on the path that carries the controls, but for the toes and the hand; the control is where the shin is.
const std::vector<std::string> kRigNames = {"path",   "control.L", "shin.L",  "thigh_twist.L", "foot.L",
                                            "toes.L", "pelvis",    "thigh.L", "chest",         "fist.L"};
const std::vector<int> kRigParents = {-1, 0, 0, 0, 0, 4, 0, 0, 0, 1};
const std::vector<int> kBearing = {2, 3, 4, 5, 6, 7, 8};

// A body that bobs and leans, whose leg swings.
std::vector<double> rig_poses(int frames) {
  std::vector<double> values;
  for (int f = 0; f < frames; ++f) {
    const double swing = 0.6 * std::sin(f), lean = 0.2 * std::cos(0.7 * f);
    const Frame pelvis = at(0.1 * f, 1 + 0.05 * std::sin(2 * f), lean), thigh = pelvis * at(0, -0.1, swing);
    const Frame shin = thigh * at(0, -0.4, 0.3 - swing / 2), foot = shin * at(0, -0.4, lean);
    const Frame chest = pelvis * at(0, 0.3, -lean), twist = thigh * at(0, -0.1);
    for (const Frame& bone :
         {at(0.1 * f, 0), shin, shin, twist, foot, foot * at(-0.1, 0), pelvis, thigh, chest, shin}) {
      add_rows(bone, values);
    }
  }
  return values;
}

TEST(Joints, AreFoundOfBonesThatHangOnControls) {
  const auto found = find_joints(kRigNames, kRigParents, rig_poses(16).data(), 16, kBearing);
  EXPECT_EQ(found, (std::map<int, int>{{2, 7}, {3, 7}, {4, 2}, {7, 6}, {8, 6}}));
}

// The knee is a joint of the thigh's twist, too, and nearer to it.
TEST(Joints, AreNoTwistBones) {
  std::vector<std::string> names = kRigNames;
  names[3] = "thigh_second.L";
  EXPECT_EQ(find_joints(names, kRigParents, rig_poses(16).data(), 16, kBearing).at(2), 3);
}

TEST(Joints, HangOnNothingThatTheyMove) {
  std::vector<int> parents = kRigParents;
  parents[7] = 1;  // the thigh is moved by the control,
  std::vector<int> bearing = kBearing;
  bearing.insert(bearing.begin(), 1);  // which the mesh follows
  const auto found = find_joints(kRigNames, parents, rig_poses(16).data(), 16, bearing);
  EXPECT_EQ(found.at(2), 1) << "the shin is where that is";
  EXPECT_EQ(found.count(7), 0u);
}

TEST(Joints, AreNoneOfASingleBone) {
  EXPECT_TRUE(find_joints(kRigNames, kRigParents, rig_poses(4).data(), 4, {6}).empty());
  EXPECT_TRUE(find_joints(kRigNames, kRigParents, rig_poses(4).data(), 4, {}).empty());
}

}  // namespace
}  // namespace fragmotion

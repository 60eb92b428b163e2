// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "add_bone.hpp"
#include "io/asf_amc.hpp"
#include "io/bvh.hpp"
#include "mocap_files.hpp"
#include "motion/take.hpp"
#include "skeleton/roles.hpp"
#include "skeleton/skeleton.hpp"
#include "small_character.hpp"

namespace fragmotion {
namespace {

constexpr double kTolerance = 1e-12;

/// Bones 1 m apart along z, each (name, parent's name); without roles.
Skeleton plain_skeleton(const std::vector<std::pair<std::string, std::string>>& bones) {
  Skeleton skeleton;
  for (const auto& [name, parent] : bones) {
    add_bone(skeleton, name, skeleton.find(parent), {0, 0, 1}, {0, 0, 0.5});
  }
  return skeleton;
}

std::string role_name(const Skeleton& skeleton, int bone) { return bone < 0 ? "none" : skeleton.names[bone]; }

using Named = std::vector<std::string>;

/// Hips, head, hands, feet, toes and thighs, left before right.
Named role_names(const Skeleton& skeleton) {
  const Roles r = find_roles(skeleton);
  Named names;
  for (const int bone : {r.hips, r.head, r.left_hand, r.right_hand, r.left_foot, r.right_foot, r.left_toe, r.right_toe,
                         r.left_thigh, r.right_thigh}) {
    names.push_back(role_name(skeleton, bone));
  }
  return names;
}

TEST(Skeleton, FindsBonesAndWhatIsBelow) {
  const Skeleton s = plain_skeleton({{"a", ""}, {"b", "a"}, {"c", "b"}, {"d", "a"}});
  EXPECT_EQ(s.find("c"), 2);
  EXPECT_EQ(s.find("C"), -1);
  EXPECT_TRUE(s.is_below(2, 0));
  EXPECT_TRUE(s.is_below(2, 2));
  EXPECT_FALSE(s.is_below(3, 1));
  EXPECT_FALSE(s.is_below(0, 1));
  EXPECT_FALSE(s.is_below(2, -1));
}

struct Broken {
  const char* what;
  void (*harm)(Skeleton&);
  const char* error;
};

TEST(Skeleton, MakeSkeletonNamesTheBoneThatIsWrong) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  const Broken cases[] = {
      {"no bones", [](Skeleton& s) { s = {}; }, "at least one bone"},
      {"sizes", [](Skeleton& s) { s.tips.pop_back(); }, "first 'a') has 2 tips"},
      {"first has a parent", [](Skeleton& s) { s.parents[0] = 1; }, "'a' is the first and must have no parent"},
      {"second root", [](Skeleton& s) { s.parents[2] = -1; }, "'c' has no parent"},
      {"child first", [](Skeleton& s) { s.parents[1] = 2; }, "'b' has parent 2"},
      {"own parent", [](Skeleton& s) { s.parents[1] = 1; }, "'b' has parent 1"},
      {"parent below -1", [](Skeleton& s) { s.parents[1] = -2; }, "'b' has parent -2"},
      {"twice", [](Skeleton& s) { s.names[2] = "a"; }, "'a' appears twice"},
      {"offset NaN", [](Skeleton& s) { s.offsets[1].y() = kNan; }, "'b' has an offset that is not finite"},
      {"tip infinite", [](Skeleton& s) { s.tips[2].x() = 1 / (1 - 1.0); }, "'c' has a tip that is not finite"},
      {"rotation NaN", [](Skeleton& s) { s.rest_rotations[1].w() = kNan; }, "'b' has a rest rotation"},
      {"rotation zero", [](Skeleton& s) { s.rest_rotations[1].coeffs().setZero(); }, "'b' has a rest rotation"},
      {"role", [](Skeleton& s) { s.roles.head = 3; }, "a role for bone 3 of 3"},
  };
  for (const Broken& broken : cases) {
    Skeleton skeleton = plain_skeleton({{"a", ""}, {"b", "a"}, {"c", "b"}});
    broken.harm(skeleton);
    const std::string error = error_of([&] { make_skeleton(skeleton); });
    EXPECT_NE(error.find(broken.error), std::string::npos) << broken.what << ": " << error;
  }
}

// Bones that hang on each other, each a metre long.
Skeleton chain(int bones) {
  Skeleton skeleton;
  for (int bone = 0; bone < bones; ++bone) {
    skeleton.names.push_back("bone" + std::to_string(bone));
    skeleton.parents.push_back(bone - 1);
  }
  skeleton.rest_rotations.assign(bones, Quaternion::Identity());
  skeleton.offsets.assign(bones, {0, 0, 1});
  skeleton.tips = skeleton.offsets;
  return skeleton;
}

TEST(Skeleton, MakeSkeletonSaysItsLimits) {
  const auto error = [](const Skeleton& skeleton) { return error_of([&] { make_skeleton(skeleton); }); };
  EXPECT_EQ(error(chain(4096)), "no error");
  EXPECT_NE(error(chain(4097)).find("4097 bones: at most 4096"), std::string::npos) << error(chain(4097));
  EXPECT_NE(error(chain(40000)).find("at most 4096"), std::string::npos);
  Skeleton skeleton = chain(3);
  skeleton.names[2] = std::string(255, 'l');
  EXPECT_EQ(error(skeleton), "no error");
  skeleton.names[2] = "l l " + std::string(200000, 'l');
  EXPECT_NE(error(skeleton).find("'l l lll"), std::string::npos) << error(skeleton);
  EXPECT_NE(error(skeleton).find("at most 255"), std::string::npos) << error(skeleton);
  for (std::vector<Vector3> Skeleton::*part : {&Skeleton::offsets, &Skeleton::tips}) {
    skeleton = chain(3);
    (skeleton.*part)[1].y() = -1e6;
    EXPECT_EQ(error(skeleton), "no error");
    (skeleton.*part)[1].y() = -1.1e6;
    EXPECT_NE(error(skeleton).find("'bone1'"), std::string::npos) << error(skeleton);
    EXPECT_NE(error(skeleton).find("1000 km"), std::string::npos) << error(skeleton);
  }
}

TEST(Skeleton, MakeSkeletonKeepsTheRolesGiven) {
  Skeleton skeleton = plain_skeleton({{"root", ""}, {"hips", "root"}, {"head", "hips"}});
  skeleton.roles.hips = 0;
  const Roles roles = make_skeleton(skeleton).roles;
  EXPECT_EQ(roles.hips, 0);
  EXPECT_EQ(roles.head, 2);
  EXPECT_EQ(roles.left_foot, -1);
}

TEST(Skeleton, RestPoseChainsOffsetsAndRotations) {
  Skeleton skeleton = plain_skeleton({{"a", ""}, {"b", "a"}, {"c", "b"}});
  skeleton.rest_rotations[1] = Quaternion(Eigen::AngleAxisd(std::acos(0.0), Vector3::UnitX()));
  std::vector<Vector3> heads;
  std::vector<Quaternion> rotations;
  rest_pose(skeleton, heads, rotations);
  EXPECT_LT((heads[2] - Vector3(0, -1, 2)).norm(), kTolerance);
  EXPECT_LT((rotations[2] * Vector3::UnitZ() - Vector3(0, -1, 0)).norm(), kTolerance);
}

TEST(Skeleton, WorldTransformsOfTheRestPoseAreTheRestPose) {
  Take take;
  take.skeleton = plain_skeleton({{"a", ""}, {"b", "a"}, {"c", "b"}});
  take.frames = 2;
  for (int i = 0; i < 6; ++i) {
    take.translations.insert(take.translations.end(), {0, 0, 1});
    take.rotations.insert(take.rotations.end(), {1, 0, 0, 0});
  }
  std::vector<double> positions, rotations;
  world_transforms(take, positions, rotations);
  EXPECT_EQ(positions, (std::vector<double>{0, 0, 1, 0, 0, 2, 0, 0, 3, 0, 0, 1, 0, 0, 2, 0, 0, 3}));
  EXPECT_EQ(rotations, take.rotations);
}

struct Rig {
  const char* what;
  std::vector<std::pair<std::string, std::string>> bones;
  Named roles;
};

std::vector<Rig> rigs() {
  return {
      {"sample rig",
       {{"root", ""},
        {"hips", "root"},
        {"spine", "hips"},
        {"head", "spine"},
        {"upper_arm.L", "spine"},
        {"hand.L", "upper_arm.L"},
        {"upper_arm.R", "spine"},
        {"hand.R", "upper_arm.R"},
        {"thigh.L", "hips"},
        {"shin.L", "thigh.L"},
        {"foot.L", "shin.L"},
        {"toe.L", "foot.L"},
        {"thigh.R", "hips"},
        {"shin.R", "thigh.R"},
        {"foot.R", "shin.R"},
        {"toe.R", "foot.R"}},
       {"hips", "head", "hand.L", "hand.R", "foot.L", "foot.R", "toe.L", "toe.R", "thigh.L", "thigh.R"}},
      {"Mixamo",
       {{"mixamorig:Hips", ""},
        {"mixamorig:Spine", "mixamorig:Hips"},
        {"mixamorig:Head", "mixamorig:Spine"},
        {"mixamorig:HeadTop_End", "mixamorig:Head"},
        {"mixamorig:LeftHand", "mixamorig:Spine"},
        {"mixamorig:LeftHandThumb1", "mixamorig:LeftHand"},
        {"mixamorig:RightHand", "mixamorig:Spine"},
        {"mixamorig:LeftUpLeg", "mixamorig:Hips"},
        {"mixamorig:LeftLeg", "mixamorig:LeftUpLeg"},
        {"mixamorig:LeftFoot", "mixamorig:LeftLeg"},
        {"mixamorig:LeftToeBase", "mixamorig:LeftFoot"},
        {"mixamorig:LeftToe_End", "mixamorig:LeftToeBase"},
        {"mixamorig:RightUpLeg", "mixamorig:Hips"},
        {"mixamorig:RightLeg", "mixamorig:RightUpLeg"},
        {"mixamorig:RightFoot", "mixamorig:RightLeg"},
        {"mixamorig:RightToeBase", "mixamorig:RightFoot"}},
       {"mixamorig:Hips", "mixamorig:Head", "mixamorig:LeftHand", "mixamorig:RightHand", "mixamorig:LeftFoot",
        "mixamorig:RightFoot", "mixamorig:LeftToeBase", "mixamorig:RightToeBase", "mixamorig:LeftUpLeg",
        "mixamorig:RightUpLeg"}},
      {"Unreal",
       {{"root", ""},
        {"pelvis", "root"},
        {"spine_01", "pelvis"},
        {"head", "spine_01"},
        {"hand_l", "spine_01"},
        {"thumb_01_l", "hand_l"},
        {"hand_r", "spine_01"},
        {"thigh_l", "pelvis"},
        {"thigh_twist_01_l", "thigh_l"},
        {"calf_l", "thigh_l"},
        {"foot_l", "calf_l"},
        {"ball_l", "foot_l"},
        {"thigh_r", "pelvis"},
        {"calf_r", "thigh_r"},
        {"foot_r", "calf_r"},
        {"ball_r", "foot_r"},
        {"ik_foot_root", "root"},
        {"ik_foot_l", "ik_foot_root"},
        {"ik_hand_l", "root"}},
       {"pelvis", "head", "hand_l", "hand_r", "foot_l", "foot_r", "ball_l", "ball_r", "thigh_l", "thigh_r"}},
      {"Biped",
       {{"Bip01", ""},
        {"Bip01 Pelvis", "Bip01"},
        {"Bip01 Spine", "Bip01 Pelvis"},
        {"Bip01 Head", "Bip01 Spine"},
        {"Bip01 HeadNub", "Bip01 Head"},
        {"Bip01 L Hand", "Bip01 Spine"},
        {"Bip01 R Hand", "Bip01 Spine"},
        {"Bip01 L Thigh", "Bip01 Pelvis"},
        {"Bip01 L Calf", "Bip01 L Thigh"},
        {"Bip01 L Foot", "Bip01 L Calf"},
        {"Bip01 L Toe0", "Bip01 L Foot"},
        {"Bip01 R Thigh", "Bip01 Pelvis"},
        {"Bip01 R Calf", "Bip01 R Thigh"},
        {"Bip01 R Foot", "Bip01 R Calf"},
        {"Bip01 R Toe0", "Bip01 R Foot"}},
       {"Bip01 Pelvis", "Bip01 Head", "Bip01 L Hand", "Bip01 R Hand", "Bip01 L Foot", "Bip01 R Foot", "Bip01 L Toe0",
        "Bip01 R Toe0", "Bip01 L Thigh", "Bip01 R Thigh"}},
      {"Rigify",
       {{"spine", ""},
        {"spine.001", "spine"},
        {"spine.002", "spine.001"},
        {"spine.006", "spine.002"},
        {"face", "spine.006"},
        {"pelvis.L", "spine"},
        {"pelvis.R", "spine"},
        {"thigh.L", "spine"},
        {"shin.L", "thigh.L"},
        {"foot.L", "shin.L"},
        {"toe.L", "foot.L"},
        {"heel.02.L", "foot.L"},
        {"thigh.R", "spine"},
        {"shin.R", "thigh.R"},
        {"foot.R", "shin.R"},
        {"toe.R", "foot.R"},
        {"heel.02.R", "foot.R"}},
       {"spine", "spine.006", "none", "none", "foot.L", "foot.R", "toe.L", "toe.R", "thigh.L", "thigh.R"}},
      {"VRM",
       {{"Root", ""},
        {"J_Bip_C_Hips", "Root"},
        {"J_Bip_C_Head", "J_Bip_C_Hips"},
        {"J_Bip_L_Hand", "J_Bip_C_Hips"},
        {"J_Bip_R_Hand", "J_Bip_C_Hips"},
        {"J_Bip_L_UpperLeg", "J_Bip_C_Hips"},
        {"J_Bip_L_Foot", "J_Bip_L_UpperLeg"},
        {"J_Bip_L_ToeBase", "J_Bip_L_Foot"},
        {"J_Bip_R_UpperLeg", "J_Bip_C_Hips"},
        {"J_Bip_R_Foot", "J_Bip_R_UpperLeg"},
        {"J_Bip_R_ToeBase", "J_Bip_R_Foot"}},
       {"J_Bip_C_Hips", "J_Bip_C_Head", "J_Bip_L_Hand", "J_Bip_R_Hand", "J_Bip_L_Foot", "J_Bip_R_Foot",
        "J_Bip_L_ToeBase", "J_Bip_R_ToeBase", "J_Bip_L_UpperLeg", "J_Bip_R_UpperLeg"}},
      {"wrists, ankles and unnamed thighs, in capitals",
       {{"HIP", ""},
        {"CHEST", "HIP"},
        {"HEAD", "CHEST"},
        {"EyeBall_L", "HEAD"},
        {"LWRIST", "CHEST"},
        {"RWRIST", "CHEST"},
        {"LHIP", "HIP"},
        {"LKNEE", "LHIP"},
        {"LANKLE", "LKNEE"},
        {"RHIP", "HIP"},
        {"RKNEE", "RHIP"},
        {"RANKLE", "RKNEE"}},
       {"HIP", "HEAD", "LWRIST", "RWRIST", "LANKLE", "RANKLE", "none", "none", "LHIP", "RHIP"}},
      {"no names that say anything",
       {{"bone", ""},
        {"bone.001", "bone"},
        {"bone.002", "bone.001"},
        {"bone.003", "bone.001"},
        {"bone.004", "bone.001"}},
       {"bone.001", "none", "none", "none", "none", "none", "none", "none", "none", "none"}},
      {"a chain",
       {{"a", ""}, {"b", "a"}},
       {"a", "none", "none", "none", "none", "none", "none", "none", "none", "none"}},
  };
}

TEST(Roles, AreFoundByTheNamesOfKnownRigs) {
  for (const Rig& rig : rigs()) EXPECT_EQ(role_names(plain_skeleton(rig.bones)), rig.roles) << rig.what;
}

TEST(Roles, OfBandaiNamco) {
  const auto files = files_in(shared_mocap() / "bandai-namco", ".bvh");
  if (files.empty()) GTEST_SKIP() << "no motion capture beside the project";
  EXPECT_EQ(role_names(read_bvh(files[0]).skeleton), (Named{"Hips", "Head", "Hand_L", "Hand_R", "Foot_L", "Foot_R",
                                                            "Toes_L", "Toes_R", "UpperLeg_L", "UpperLeg_R"}));
}

TEST(Roles, OfCmu) {
  const auto cmu = shared_mocap() / "cmu";
  if (!std::filesystem::exists(cmu / "01_01.bvh")) GTEST_SKIP() << "no motion capture beside the project";
  EXPECT_EQ(role_names(read_asf(cmu / "01.asf")),
            (Named{"root", "head", "lhand", "rhand", "lfoot", "rfoot", "ltoes", "rtoes", "lfemur", "rfemur"}));
  EXPECT_EQ(role_names(read_bvh(cmu / "01_01.bvh").skeleton),
            (Named{"Hips", "Head", "LeftHand", "RightHand", "LeftFoot", "RightFoot", "LeftToeBase", "RightToeBase",
                   "LeftUpLeg", "RightUpLeg"}));
}

TEST(MirrorBones, PairsEveryWayOfNamingSides) {
  const std::pair<std::string, std::string> pairs[] = {{"thigh.L", "thigh.R"},
                                                       {"thigh.L.001", "thigh.R.001"},
                                                       {"Foot_L", "Foot_R"},
                                                       {"hand-l", "hand-r"},
                                                       {"Bip01 L Thigh", "Bip01 R Thigh"},
                                                       {"toe L", "toe R"},
                                                       {"L_arm", "R_arm"},
                                                       {"mixamorig:LeftUpLeg", "mixamorig:RightUpLeg"},
                                                       {"Armature|eye_left", "Armature|eye_right"},
                                                       {"LHipJoint", "RHipJoint"},
                                                       {"lfemur", "rfemur"},
                                                       {"leftear", "rightear"},
                                                       {"LEFTKNEE", "RIGHTKNEE"}};
  for (const auto& [left, right] : pairs) {
    const Skeleton skeleton = plain_skeleton({{"hips", ""}, {left, "hips"}, {right, "hips"}});
    EXPECT_EQ(mirror_bones(skeleton), (std::vector<int>{0, 2, 1})) << left;
  }
}

TEST(MirrorBones, LeavesAloneWhatHasNoCounterpart) {
  for (const char* name : {"lowerback", "root", "leg", "Foot.L", "LeftFoot", "L5", "ribs", "left:bone"}) {
    const Skeleton skeleton = plain_skeleton({{"hips", ""}, {name, "hips"}, {"other", "hips"}});
    EXPECT_EQ(mirror_bones(skeleton), (std::vector<int>{0, 1, 2})) << name;
  }
}

TEST(MirrorBones, IsItsOwnInverse) {
  const Skeleton skeleton = plain_skeleton({{"a", ""}, {"f.L", "a"}, {"f.l", "a"}, {"f.R", "a"}, {"f.r", "a"}});
  const std::vector<int> mirror = mirror_bones(skeleton);
  for (int bone = 0; bone < skeleton.size(); ++bone) EXPECT_EQ(mirror[mirror[bone]], bone);
}

TEST(Stature, IsCheckedToBeALength) {
  const auto error = [](double size) {
    Skeleton skeleton = chain(2);
    for (auto* part : {&skeleton.offsets, &skeleton.tips}) part->assign(2, {0, 0, size});
    return error_of([&] { check_stature(make_skeleton(skeleton)); });
  };
  for (const double size : {1e-3, 1.0, 1e6}) EXPECT_EQ(error(size), "no error") << size;
  for (const double size : {0.0, 1e-300, 1e-4}) EXPECT_NE(error(size).find("'bone0'"), std::string::npos) << size;
}

TEST(Roles, TakeTheLegForTheThighWhereThereIsNoKnee) {
  for (const bool root : {false, true}) {
    const Skeleton s = kneeless_skeleton(root);
    EXPECT_EQ(s.roles.left_thigh, s.find("leg.L"));
    EXPECT_EQ(s.roles.right_thigh, s.find("leg.R"));
  }
}

TEST(Roles, OfALegWithoutAFootItsLastBoneIsTheFoot) {
  const Skeleton one = make_skeleton(plain_skeleton(
      {{"root", ""}, {"leg-left", "root"}, {"leg-right", "root"}, {"torso", "root"}, {"head", "torso"}}));
  EXPECT_EQ(one.roles.left_thigh, one.find("leg-left"));
  EXPECT_EQ(one.roles.left_foot, one.find("leg-left"));
  EXPECT_EQ(one.roles.right_foot, one.find("leg-right"));
  const Skeleton two = make_skeleton(plain_skeleton({{"hips", ""},
                                                     {"leg_upper.L", "hips"},
                                                     {"leg_lower.L", "leg_upper.L"},
                                                     {"leg_upper.R", "hips"},
                                                     {"leg_lower.R", "leg_upper.R"},
                                                     {"head", "hips"}}));
  EXPECT_EQ(two.roles.left_thigh, two.find("leg_upper.L"));
  EXPECT_EQ(two.roles.left_foot, two.find("leg_lower.L"));
  EXPECT_EQ(two.roles.right_foot, two.find("leg_lower.R"));
}

TEST(Roles, TakeNoBoneThatCarriesBothLegsForAThigh) {
  Skeleton s = chain(6);  // hips > carrier > leg.L > foot.L, leg.R > foot.R
  s.names = {"hips", "carrier", "leg.L", "foot.L", "leg.R", "foot.R"};
  s.parents = {-1, 0, 1, 2, 1, 4};
  s = make_skeleton(s);
  EXPECT_EQ(s.roles.left_thigh, s.find("leg.L"));
  EXPECT_EQ(s.roles.right_thigh, s.find("leg.R"));
  s = chain(3);
  s.names = {"hips", "foot.L", "foot.R"};
  s.parents = {-1, 0, 0};
  s = make_skeleton(s);
  EXPECT_EQ(s.roles.left_thigh, -1) << "a foot on the hips has no thigh";
}

TEST(Stature, FollowsTheLegsWhateverTheRestPose) {
  Skeleton skeleton = make_skeleton(plain_skeleton(rigs()[0].bones));
  EXPECT_NEAR(stature(skeleton), 2 / 0.491, kTolerance) << "thigh and shin, of a metre each";
  for (Vector3& offset : skeleton.offsets) offset = Vector3(offset.z(), 0, 0);
  EXPECT_NEAR(stature(skeleton), 2 / 0.491, kTolerance);
}

TEST(Stature, IsTheLongestChainWhereRolesAreMissing) {
  EXPECT_NEAR(stature(make_skeleton(plain_skeleton({{"a", ""}, {"b", "a"}, {"c", "b"}}))), 2.5, kTolerance);
  const Skeleton cat = plain_skeleton({{"a", ""}, {"tail", "a"}, {"neck", "a"}, {"nose", "neck"}});
  EXPECT_NEAR(stature(make_skeleton(cat)), 4, kTolerance);
}

TEST(MeasuredBones, LeaveOutFingersFaceAndWhatIsAboveTheHips) {
  auto bones = rigs()[0].bones;
  bones.insert(
      bones.end(),
      {{"eye.L", "head"}, {"jaw", "head"}, {"palm.L", "hand.L"}, {"thumb.L", "upper_arm.L"}, {"prop", "root"}});
  const Skeleton skeleton = make_skeleton(plain_skeleton(bones));
  const std::vector<int> measured = measured_bones(skeleton);
  EXPECT_EQ(measured.size(), rigs()[0].bones.size() - 1);
  EXPECT_EQ(measured.front(), 1);
  EXPECT_EQ(skeleton.names[measured.back()], "toe.R");
}

TEST(MeasuredBones, HoldTheHipsWhateverTheRoles) {
  Skeleton skeleton;
  skeleton.names = {"head", "hips", "spine"};
  skeleton.parents = {-1, 0, 1};
  skeleton.rest_rotations.assign(3, Quaternion::Identity());
  skeleton.offsets.assign(3, {0, 0, 1});
  skeleton.tips = skeleton.offsets;
  skeleton.roles.head = 0;
  EXPECT_EQ(measured_bones(make_skeleton(skeleton)), std::vector<int>{1});
}

}  // namespace
}  // namespace fragmotion

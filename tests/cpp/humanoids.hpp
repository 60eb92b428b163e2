// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "add_bone.hpp"
#include "skeleton/skeleton.hpp"

namespace fragmotion {

/// How a family of rigs names and hangs the bones of a body; '@' stands for the side.
struct Family {
  std::string what;
  std::string left, right;         ///< What '@' stands for.
  std::vector<std::string> above;  ///< From the first bone to the hips' parent.
  std::string hips;
  std::vector<std::string> spine, neck;
  std::string head;
  std::string arms_on, legs_on;  ///< What the limbs hang on; empty: the last bone of the spine, the hips.
  std::vector<std::string> arm;  ///< Shoulder, upper arm, lower arm, hand.
  std::vector<std::string> leg;  ///< Thigh, shin, foot, toe or none.
  std::vector<std::pair<std::string, std::string>> others;  ///< What has no role, and what it hangs on.
};

/// A body of 1.75 m in a T pose that faces -y, z up, in bones named as a family does. Frames are the world's axes.
class Humanoid {
 public:
  explicit Humanoid(const Family& family) {
    std::string last;
    for (const std::string& name : family.above) last = add(name, last, {0, 0, 0}, {0, 0, 0.1});
    const int spines = static_cast<int>(family.spine.size()), necks = static_cast<int>(family.neck.size());
    add(family.hips, last, {0, 0, 0.95}, {0, 0, 0.1});
    roles["hips"] = family.hips;
    if (!family.above.empty()) roles["root"] = family.above[0];
    last = family.hips;
    for (int i = 0; i < spines; ++i) {
      last = add(family.spine[i], last, {0, 0, 1.02 + 0.4 * i / spines}, {0, 0, 0.1});
      roles["spine_" + std::to_string(i + 1)] = last;
    }
    const std::string chest = family.arms_on.empty() ? last : family.arms_on;
    for (int i = 0; i < necks; ++i) {
      last = add(family.neck[i], last, {0, 0, 1.45 + 0.1 * i / necks}, {0, 0, 0.1});
      roles["neck_" + std::to_string(i + 1)] = last;
    }
    add(family.head, last, {0, -0.02, 1.55}, {0, 0, 0.2});
    roles["head"] = family.head;
    for (const bool left : {true, false}) {
      add_leg(family, left);
      add_arm(family, left, sided(family, left, chest));
      for (const auto& [name, parent] : family.others) {
        const std::string whose = sided(family, left, name), on = sided(family, left, parent);
        if (skeleton.find(whose) < 0) add(whose, on, place_[on] + Vector3{0.0, 0.015, -0.01}, {0, 0.02, 0});
      }
    }
  }

  Skeleton skeleton;
  std::map<std::string, std::string> roles;

 private:
  static std::string sided(const Family& family, bool left, std::string name) {
    const std::size_t at = name.find('@');
    return at == std::string::npos ? name : name.replace(at, 1, left ? family.left : family.right);
  }

  std::string add(const std::string& name, const std::string& parent, const Vector3& head, const Vector3& tip) {
    const int above = skeleton.find(parent);
    add_bone(skeleton, name, above, above < 0 ? head : Vector3{head - place_[parent]}, tip);
    place_[name] = head;
    return name;
  }

  void add_limb(const Family& family, bool left, const std::vector<std::string>& names,
                const std::vector<std::string>& labels, const std::vector<Vector3>& heads, std::string on) {
    for (std::size_t i = 0; i < names.size(); ++i) {
      if (names[i].empty()) continue;
      const Vector3 mirror{left ? 1.0 : -1.0, 1, 1};
      const Vector3 end = i + 1 < heads.size() ? heads[i + 1] : Vector3{heads[i] + Vector3{0, -0.06, 0}};
      on = add(sided(family, left, names[i]), on, mirror.cwiseProduct(heads[i]), mirror.cwiseProduct(end - heads[i]));
      roles[(left ? "left_" : "right_") + labels[i]] = on;
    }
  }

  void add_leg(const Family& family, bool left) {
    const std::string on = sided(family, left, family.legs_on.empty() ? family.hips : family.legs_on);
    const double side = on == family.legs_on ? 0 : left ? 1 : -1;
    if (skeleton.find(on) < 0) add(on, family.hips, {0.03 * side, 0, 0.94}, {0.06 * side, 0, -0.02});
    add_limb(family, left, family.leg, {"thigh", "shin", "foot", "toe"},
             {{0.09, 0, 0.92}, {0.09, -0.01, 0.5}, {0.09, 0.02, 0.09}, {0.09, -0.11, 0.02}}, on);
  }

  void add_arm(const Family& family, bool left, const std::string& chest) {
    add_limb(family, left, family.arm, {"shoulder", "upper_arm", "lower_arm", "hand"},
             {{0.03, 0, 1.42}, {0.17, 0.01, 1.42}, {0.45, 0.02, 1.42}, {0.71, 0, 1.42}}, chest);
  }

  std::map<std::string, Vector3> place_;
};

/// The families of rigs that people have, by the names and the order of their bones.
inline std::vector<Family> families() {
  return {
      {"CMU's BVH",
       "Left",
       "Right",
       {},
       "Hips",
       {"LowerBack", "Spine", "Spine1"},
       {"Neck", "Neck1"},
       "Head",
       "",
       "@HipJoint",
       {"@Shoulder", "@Arm", "@ForeArm", "@Hand"},
       {"@UpLeg", "@Leg", "@Foot", "@ToeBase"},
       {{"@FingerBase", "@Hand"}}},
      {"CMU's ASF",
       "l",
       "r",
       {},
       "root",
       {"lowerback", "upperback", "thorax"},
       {"lowerneck", "upperneck"},
       "head",
       "",
       "@hipjoint",
       {"@clavicle", "@humerus", "@radius", "@hand"},
       {"@femur", "@tibia", "@foot", "@toes"},
       {}},
      {"Bandai Namco",
       "L",
       "R",
       {"joint_Root"},
       "Hips",
       {"Spine", "Chest"},
       {"Neck"},
       "Head",
       "",
       "",
       {"Shoulder_@", "UpperArm_@", "LowerArm_@", "Hand_@"},
       {"UpperLeg_@", "LowerLeg_@", "Foot_@", "Toes_@"},
       {}},
      {"LAFAN1",
       "Left",
       "Right",
       {},
       "Hips",
       {"Spine", "Spine1", "Spine2"},
       {"Neck"},
       "Head",
       "",
       "",
       {"@Shoulder", "@Arm", "@ForeArm", "@Hand"},
       {"@UpLeg", "@Leg", "@Foot", "@Toe"},
       {}},
      {"100STYLE",
       "Left",
       "Right",
       {},
       "Hips",
       {"Chest", "Chest2", "Chest3", "Chest4"},
       {"Neck"},
       "Head",
       "",
       "",
       {"@Collar", "@Shoulder", "@Elbow", "@Wrist"},
       {"@Hip", "@Knee", "@Ankle", "@Toe"},
       {}},
      {"GAMES105, its joints named after what they join",
       "l",
       "r",
       {},
       "RootJoint",
       {"pelvis_lowerback", "lowerback_torso"},
       {},
       "torso_head",
       "",
       "",
       {"@Torso_Clavicle", "@Shoulder", "@Elbow", "@Wrist"},
       {"@Hip", "@Knee", "@Ankle", "@ToeJoint"},
       {}},
      {"Mixamo",
       "Left",
       "Right",
       {},
       "mixamorig:Hips",
       {"mixamorig:Spine", "mixamorig:Spine1", "mixamorig:Spine2"},
       {"mixamorig:Neck"},
       "mixamorig:Head",
       "",
       "",
       {"mixamorig:@Shoulder", "mixamorig:@Arm", "mixamorig:@ForeArm", "mixamorig:@Hand"},
       {"mixamorig:@UpLeg", "mixamorig:@Leg", "mixamorig:@Foot", "mixamorig:@ToeBase"},
       {{"mixamorig:HeadTop_End", "mixamorig:Head"}, {"mixamorig:@Toe_End", "mixamorig:@ToeBase"}}},
      {"Rigify's meta-rig",
       "L",
       "R",
       {},
       "spine",
       {"spine.001", "spine.002", "spine.003"},
       {"spine.004", "spine.005"},
       "spine.006",
       "spine.003",
       "",
       {"shoulder.@", "upper_arm.@", "forearm.@", "hand.@"},
       {"thigh.@", "shin.@", "foot.@", "toe.@"},
       {{"pelvis.@", "spine"},
        {"breast.@", "spine.003"},
        {"heel.02.@", "foot.@"},
        {"face", "spine.006"},
        {"jaw", "face"}}},
      {"Rigify's deform bones",
       "L",
       "R",
       {"root"},
       "DEF-spine",
       {"DEF-spine.001", "DEF-spine.002", "DEF-spine.003"},
       {"DEF-spine.004", "DEF-spine.005"},
       "DEF-spine.006",
       "DEF-spine.003",
       "",
       {"DEF-shoulder.@", "DEF-upper_arm.@", "DEF-forearm.@", "DEF-hand.@"},
       {"DEF-thigh.@", "DEF-shin.@", "DEF-foot.@", "DEF-toe.@"},
       {{"ORG-thigh.@", "DEF-spine"},
        {"MCH-foot.@", "root"},
        {"thigh_ik.@", "root"},
        {"foot_ik.@", "root"},
        {"upper_arm_fk.@", "DEF-shoulder.@"},
        {"hand_ik.@", "root"},
        {"head", "root"},
        {"hips", "root"}}},
      {"Unreal",
       "l",
       "r",
       {"root"},
       "pelvis",
       {"spine_01", "spine_02", "spine_03", "spine_04", "spine_05"},
       {"neck_01", "neck_02"},
       "head",
       "",
       "",
       {"clavicle_@", "upperarm_@", "lowerarm_@", "hand_@"},
       {"thigh_@", "calf_@", "foot_@", "ball_@"},
       {{"ik_foot_root", "root"}, {"ik_foot_@", "ik_foot_root"}, {"ik_hand_@", "root"}, {"thigh_bck_@", "thigh_@"}}},
      {"Unity's humanoid",
       "Left",
       "Right",
       {"Armature"},
       "Hips",
       {"Spine", "Chest", "UpperChest"},
       {"Neck"},
       "Head",
       "",
       "",
       {"@Shoulder", "@UpperArm", "@LowerArm", "@Hand"},
       {"@UpperLeg", "@LowerLeg", "@Foot", "@Toes"},
       {}},
      {"MakeHuman",
       "L",
       "R",
       {},
       "root",
       {"spine05", "spine04", "spine03", "spine02", "spine01"},
       {"neck01", "neck02", "neck03"},
       "head",
       "",
       "pelvis.@",
       {"shoulder01.@", "upperarm01.@", "lowerarm01.@", "wrist.@"},
       {"upperleg01.@", "lowerleg01.@", "foot.@", "toe1-1.@"},
       {{"breast.@", "spine02"}, {"jaw", "head"}}},
      {"VRoid",
       "L",
       "R",
       {"Root"},
       "J_Bip_C_Hips",
       {"J_Bip_C_Spine", "J_Bip_C_Chest", "J_Bip_C_UpperChest"},
       {"J_Bip_C_Neck"},
       "J_Bip_C_Head",
       "",
       "",
       {"J_Bip_@_Shoulder", "J_Bip_@_UpperArm", "J_Bip_@_LowerArm", "J_Bip_@_Hand"},
       {"J_Bip_@_UpperLeg", "J_Bip_@_LowerLeg", "J_Bip_@_Foot", "J_Bip_@_ToeBase"},
       {{"J_Adj_@_FaceEye", "J_Bip_C_Head"},
        {"J_Sec_Hair1_01", "J_Bip_C_Head"},
        {"J_Sec_@_Bust1", "J_Bip_C_UpperChest"}}},
      {"Daz",
       "l",
       "r",
       {"Genesis8"},
       "hip",
       {"abdomenLower", "abdomenUpper", "chestLower", "chestUpper"},
       {"neckLower", "neckUpper"},
       "head",
       "",
       "pelvis",
       {"@Collar", "@ShldrBend", "@ForearmBend", "@Hand"},
       {"@ThighBend", "@Shin", "@Foot", "@Toe"},
       {{"@Pectoral", "chestLower"}, {"@Eye", "head"}}},
      {"Biped",
       "L",
       "R",
       {"Bip01"},
       "Bip01 Pelvis",
       {"Bip01 Spine", "Bip01 Spine1", "Bip01 Spine2"},
       {"Bip01 Neck"},
       "Bip01 Head",
       "Bip01 Neck",
       "Bip01 Spine",
       {"Bip01 @ Clavicle", "Bip01 @ UpperArm", "Bip01 @ Forearm", "Bip01 @ Hand"},
       {"Bip01 @ Thigh", "Bip01 @ Calf", "Bip01 @ Foot", "Bip01 @ Toe0"},
       {{"Bip01 HeadNub", "Bip01 Head"}, {"Bip01 @ Toe0Nub", "Bip01 @ Toe0"}, {"Bip01 Footsteps", "Bip01"}}},
      {"Rokoko",
       "Left",
       "Right",
       {"Root"},
       "Hips",
       {"Spine1", "Spine2", "Spine3", "Spine4"},
       {"Neck"},
       "Head",
       "",
       "",
       {"@Shoulder", "@Arm", "@ForeArm", "@Hand"},
       {"@Thigh", "@Shin", "@Foot", "@Toe"},
       {{"@ToeTip", "@Toe"}}},
      {"Perception Neuron",
       "Left",
       "Right",
       {},
       "Robot_Hips",
       {"Robot_Spine", "Robot_Spine1", "Robot_Spine2"},
       {"Robot_Neck", "Robot_Neck1"},
       "Robot_Head",
       "",
       "",
       {"Robot_@Shoulder", "Robot_@Arm", "Robot_@ForeArm", "Robot_@Hand"},
       {"Robot_@UpLeg", "Robot_@Leg", "Robot_@Foot"},
       {}},
      {"Xsens",
       "Left",
       "Right",
       {},
       "Hips",
       {"L5", "L3", "T12", "T8"},
       {"Neck"},
       "Head",
       "",
       "",
       {"@Collar", "@Shoulder", "@Elbow", "@Wrist"},
       {"@Hip", "@Knee", "@Ankle", "@Toe"},
       {}},
      {"Character Creator",
       "L",
       "R",
       {"CC_Base_BoneRoot"},
       "CC_Base_Hip",
       {"CC_Base_Waist", "CC_Base_Spine01", "CC_Base_Spine02"},
       {"CC_Base_NeckTwist01", "CC_Base_NeckTwist02"},
       "CC_Base_Head",
       "CC_Base_Spine02",
       "CC_Base_Pelvis",
       {"CC_Base_@_Clavicle", "CC_Base_@_Upperarm", "CC_Base_@_Forearm", "CC_Base_@_Hand"},
       {"CC_Base_@_Thigh", "CC_Base_@_Calf", "CC_Base_@_Foot", "CC_Base_@_ToeBase"},
       {{"CC_Base_@_KneeShareBone", "CC_Base_@_Calf"},
        {"CC_Base_@_ElbowShareBone", "CC_Base_@_Forearm"},
        {"CC_Base_@_Eye", "CC_Base_Head"},
        {"CC_Base_@_RibsTwist", "CC_Base_Spine02"}}},
      {"SMPL",
       "L",
       "R",
       {},
       "Pelvis",
       {"Spine1", "Spine2", "Spine3"},
       {"Neck"},
       "Head",
       "",
       "",
       {"@_Collar", "@_Shoulder", "@_Elbow", "@_Wrist"},
       {"@_Hip", "@_Knee", "@_Ankle", "@_Foot"},
       {{"@_Hand", "@_Wrist"}}},
      {"AdvancedSkeleton",
       "L",
       "R",
       {},
       "Root_M",
       {"Spine1_M", "Chest_M"},
       {"Neck_M"},
       "Head_M",
       "",
       "",
       {"Scapula_@", "Shoulder_@", "Elbow_@", "Wrist_@"},
       {"Hip_@", "Knee_@", "Ankle_@", "Toes_@"},
       {}},
      {"MMD",
       "左",
       "右",
       {"全ての親"},
       "センター",
       {"上半身", "上半身2"},
       {"首"},
       "頭",
       "",
       "下半身",
       {"@肩", "@腕", "@ひじ", "@手首"},
       {"@足", "@ひざ", "@足首", "@つま先"},
       {{"@足ＩＫ", "全ての親"}, {"@目", "頭"}}},
      {"Second Life",
       "Left",
       "Right",
       {},
       "mPelvis",
       {"mSpine1", "mSpine2", "mTorso", "mSpine3", "mSpine4", "mChest"},
       {"mNeck"},
       "mHead",
       "",
       "",
       {"mCollar@", "mShoulder@", "mElbow@", "mWrist@"},
       {"mHip@", "mKnee@", "mAnkle@", "mFoot@"},
       {{"mSkull", "mHead"},
        {"HEAD", "mHead"},
        {"mGroin", "mPelvis"},
        {"PELVIS", "mPelvis"},
        {"@_UPPER_ARM", "mShoulder@"},
        {"@_LOWER_ARM", "mElbow@"},
        {"@_UPPER_LEG", "mHip@"}}},
      {"Russian",
       "левая",
       "правая",
       {},
       "таз",
       {"спина", "грудь"},
       {"шея"},
       "голова",
       "",
       "",
       {"@ ключица", "@ плечо", "@ предплечье", "@ кисть"},
       {"@ бедро", "@ голень", "@ стопа", "@ носок"},
       {}},
  };
}

}  // namespace fragmotion

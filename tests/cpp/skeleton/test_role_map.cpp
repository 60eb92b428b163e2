// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "add_bone.hpp"
#include "base/random.hpp"
#include "dog.hpp"
#include "humanoids.hpp"
#include "mocap_files.hpp"
#include "skeleton/body_words.hpp"
#include "skeleton/role_map.hpp"
#include "skeleton/roles.hpp"

namespace fragmotion {
namespace {

using Names = std::map<std::string, std::string>;

Family family_named(const std::string& what) {
  for (const Family& family : families()) {
    if (family.what == what) return family;
  }
  throw std::logic_error("no family '" + what + "'");
}

/// The humanoid with names that say nothing, and the true roles by those.
Humanoid nameless(Humanoid body) {
  Names renamed;
  for (int b = 0; b < body.skeleton.size(); ++b) {
    const std::string name = "Bone." + std::to_string(100 + b);
    renamed[body.skeleton.names[b]] = name;
    body.skeleton.names[b] = name;
  }
  for (auto& [role, bone] : body.roles) bone = renamed[bone];
  return body;
}

/// The roles told that are not the true ones.
std::vector<std::string> wrong(const Humanoid& body, const RoleMap& map) {
  std::vector<std::string> wrong;
  for (const auto& [role, bone] : named_bones(body.skeleton, map)) {
    const auto truth = body.roles.find(role);
    if (truth == body.roles.end() || truth->second != bone) wrong.push_back(role + " = " + bone);
  }
  return wrong;
}

TEST(RoleMap, IsRightForEveryFamilyOfRigs) {
  for (const Family& family : families()) {
    const Humanoid body(family);
    const RoleMap map = find_role_map(make_skeleton(body.skeleton));
    EXPECT_EQ(named_bones(body.skeleton, map), body.roles) << family.what;
    for (const RoleBone& bone : map.bones) {
      EXPECT_GE(bone.confidence, 0.5) << family.what << ", " << role_label(bone);
      EXPECT_LE(bone.confidence, 1) << family.what << ", " << role_label(bone);
    }
  }
}

TEST(RoleMap, GivesNoBoneAndNoRoleTwice) {
  for (const Family& family : families()) {
    const RoleMap map = find_role_map(Humanoid(family).skeleton);
    std::set<int> bones;
    std::set<std::string> labels;
    for (const RoleBone& bone : map.bones) {
      bones.insert(bone.bone);
      labels.insert(role_label(bone));
    }
    for (const TwistBone& twist : map.twists) bones.insert(twist.bone);
    EXPECT_EQ(bones.size(), map.bones.size() + map.twists.size()) << family.what;
    EXPECT_EQ(labels.size(), map.bones.size()) << family.what;
  }
}

TEST(RoleMap, IsToldByTheShapeWhereNamesSayNothing) {
  const Humanoid body = nameless(Humanoid(family_named("Bandai Namco")));
  const RoleMap map = find_role_map(body.skeleton);
  EXPECT_EQ(named_bones(body.skeleton, map), body.roles);
  EXPECT_LT(map.confidence(Role::kHips),
            find_role_map(Humanoid(family_named("Mixamo")).skeleton).confidence(Role::kHips));
}

TEST(RoleMap, WithoutNamesNoFamilyIsToldWrong) {
  int told = 0, all = 0;
  for (const Family& family : families()) {
    if (family.what == "Biped") continue;  // whose legs hang on the spine: names alone tell its hips
    const Humanoid body = nameless(Humanoid(family));
    const RoleMap map = find_role_map(body.skeleton);
    EXPECT_EQ(wrong(body, map), std::vector<std::string>{}) << family.what;
    told += static_cast<int>(map.bones.size());
    all += static_cast<int>(body.roles.size());
  }
  EXPECT_GE(told, 0.9 * all) << told << " of " << all;
}

TEST(RoleMap, IsToldByTheShapeWhereverTheBodyStands) {
  Humanoid body = nameless(Humanoid(family_named("Bandai Namco")));
  body.skeleton.offsets[1] += Vector3{30, 40, 0};  // of the hips, as in files that begin far from the origin
  EXPECT_EQ(named_bones(body.skeleton, find_role_map(body.skeleton)), body.roles);
}

TEST(RoleMap, GoesByTheLastWordOfAJointThatIsNamedAfterWhatItJoins) {
  for (const auto& [name, role] : {std::pair{"torso_head", Role::kHead},
                                   {"pelvis_lowerback", Role::kSpine},
                                   {"chest_neck", Role::kNeck},
                                   {"head_end", Role::kHead}}) {
    const std::array<double, kRoles> said = says(read_names({name})[0]);
    EXPECT_EQ(std::max_element(said.begin(), said.end()) - said.begin(), static_cast<int>(role)) << name;
  }
}

TEST(RoleMap, TellsNoHeadThatIsNoLongerThanANeck) {
  const Humanoid named(family_named("Bandai Namco"));
  const Humanoid body = nameless(named);
  for (const double length : {0.02, 0.05, 0.1}) {
    Skeleton skeleton = body.skeleton;
    skeleton.tips[named.skeleton.find("Neck")] = {0, 0, 0.07};
    skeleton.tips[named.skeleton.find("Head")] = {0, 0, length};
    const int head = find_role_map(skeleton).bone(Role::kHead);
    EXPECT_TRUE(head == -1 || skeleton.names[head] == body.roles.at("head")) << length;
  }
}

/// Names dealt anew among the bones lie; what is told then must be told by the shape.
TEST(RoleMap, IsRightOrSilentWhereNamesLie) {
  Random random(5);
  const Humanoid honest(family_named("LAFAN1"));
  for (int trial = 0; trial < 50; ++trial) {
    Humanoid body = honest;
    for (int b = body.skeleton.size() - 1; b > 0; --b) {
      std::swap(body.skeleton.names[b], body.skeleton.names[static_cast<int>(random.uniform() * (b + 1))]);
    }
    for (auto& [role, bone] : body.roles) bone = body.skeleton.names[honest.skeleton.find(bone)];
    EXPECT_EQ(wrong(body, find_role_map(body.skeleton)), std::vector<std::string>{}) << trial;
  }
}

/// The same bones hung on another one of them.
Humanoid rerooted(const Humanoid& body, int root) {
  std::vector<Vector3> heads;
  std::vector<Quaternion> rotations;
  rest_pose(body.skeleton, heads, rotations);
  const Skeleton& from = body.skeleton;
  std::vector<int> order{root}, parents{-1};
  for (std::size_t i = 0; i < order.size(); ++i) {
    for (int b = 0; b < from.size(); ++b) {
      const bool joined = from.parents[b] == order[i] || from.parents[order[i]] == b;
      if (!joined || std::find(order.begin(), order.end(), b) != order.end()) continue;
      order.push_back(b);
      parents.push_back(static_cast<int>(i));
    }
  }
  Humanoid result = body;
  for (std::size_t i = 0; i < order.size(); ++i) {
    result.skeleton.names[i] = from.names[order[i]];
    result.skeleton.parents[i] = parents[i];
    result.skeleton.tips[i] = from.tips[order[i]];
    result.skeleton.offsets[i] = parents[i] < 0 ? heads[order[i]] : Vector3{heads[order[i]] - heads[order[parents[i]]]};
  }
  return result;
}

TEST(RoleMap, IsRightOrSilentHungOnAnotherBone) {
  const Humanoid body(family_named("LAFAN1"));
  for (int root = 1; root < body.skeleton.size(); ++root) {
    Humanoid other = rerooted(body, root);
    other.roles["root"] = other.skeleton.names[0];
    EXPECT_EQ(wrong(other, find_role_map(other.skeleton)), std::vector<std::string>{}) << body.skeleton.names[root];
    other = nameless(other);
    EXPECT_EQ(wrong(other, find_role_map(other.skeleton)), std::vector<std::string>{}) << body.skeleton.names[root];
  }
}

TEST(RoleMap, SaysNothingOfWhatIsNoBody) {
  Skeleton chain;
  for (int b = 0; b < 30; ++b) {
    add_bone(chain, "joint" + std::to_string(b), b - 1, {0, 0, 0.1}, {0, 0, 0.1});
  }
  EXPECT_TRUE(find_role_map(chain).bones.empty());
  Skeleton one = chain;
  one.names.resize(1);
  one.parents.resize(1);
  one.rest_rotations.resize(1);
  one.offsets.resize(1);
  one.tips.resize(1);
  EXPECT_TRUE(find_role_map(one).bones.empty());
}

/// Appends a bone to a skeleton whose frames are the world's axes.
void append(Skeleton& skeleton, const std::string& name, const std::string& parent, const Vector3& offset) {
  add_bone(skeleton, name, skeleton.find(parent), offset, {0.02, 0, 0});
}

TEST(RoleMap, TellsTwistBonesAndTheirShareApart) {
  Skeleton skeleton = Humanoid(family_named("Unreal")).skeleton;
  append(skeleton, "lowerarm_twist_01_l", "lowerarm_l", {0.13, -0.01, 0});
  append(skeleton, "thigh_twist_01_r", "thigh_r", {0, 0, 0});
  const RoleMap map = find_role_map(skeleton);
  ASSERT_EQ(map.twists.size(), 2u);
  EXPECT_EQ(skeleton.names[map.twists[0].bone], "lowerarm_twist_01_l");
  EXPECT_EQ(map.twists[0].limb, map.bone(Role::kLowerArm, Side::kLeft));
  EXPECT_NEAR(map.twists[0].share, 0.5, 0.01);
  EXPECT_EQ(skeleton.names[map.twists[1].bone], "thigh_twist_01_r");
  EXPECT_NEAR(map.twists[1].share, 0, 1e-9);
}

struct FingerCase {
  const char* family;
  std::vector<std::string> bones;  ///< From the hand.
  std::string hand, role;
};

TEST(RoleMap, CountsFingersAsTheFamilyDoes) {
  const FingerCase cases[] = {
      {"Mixamo", {"mixamorig:LeftHandIndex1", "mixamorig:LeftHandIndex2"}, "mixamorig:LeftHand", "left_index_"},
      {"Biped", {"Bip01 L Finger0", "Bip01 L Finger01"}, "Bip01 L Hand", "left_thumb_"},
      {"MakeHuman", {"finger2-1.L", "finger2-2.L"}, "wrist.L", "left_index_"},
      {"Unreal", {"pinky_01_l", "pinky_02_l"}, "hand_l", "left_pinky_"},
      {"MMD", {"左中指１", "左中指２"}, "左手首", "left_middle_"},
  };
  for (const FingerCase& finger : cases) {
    Skeleton skeleton = Humanoid(family_named(finger.family)).skeleton;
    std::string last = finger.hand;
    for (const std::string& bone : finger.bones) append(skeleton, bone, last, {0.03, 0, 0}), last = bone;
    const Names named = named_bones(skeleton, find_role_map(skeleton));
    for (std::size_t i = 0; i < finger.bones.size(); ++i) {
      const auto found = named.find(finger.role + std::to_string(i + 1));
      ASSERT_NE(found, named.end()) << finger.family;
      EXPECT_EQ(found->second, finger.bones[i]) << finger.family;
    }
  }
}

// Helpers of MMD's models, by which a hand closes.
TEST(RoleMap, AFingerThatCarriesNoSkinGivesWayToOneThatDoes) {
  Skeleton skeleton = Humanoid(family_named("MMD")).skeleton;
  for (const std::string bone : {"左人指_握り", "左人指１"}) append(skeleton, bone, "左手首", {0.03, 0, 0});
  const auto index = [&](const Skin* skin) {
    return named_bones(skeleton, find_role_map(skeleton, nullptr, Sides::of_the_body, skin)).at("left_index_1");
  };
  Skin skin;
  skin.points.assign(1, Vector3::Zero());
  skin.weights.push_back({0, skeleton.find("左手首"), 1});
  EXPECT_EQ(index(nullptr), "左人指_握り");
  EXPECT_EQ(index(&skin), "左人指_握り") << "neither does";
  skin.weights.push_back({0, skeleton.find("左人指１"), 1});
  EXPECT_EQ(index(&skin), "左人指１");
}

TEST(RoleMap, CountsFingersByTheirOwnNumbers) {
  Skeleton skeleton = Humanoid(family_named("Biped")).skeleton;
  for (const char* bone : {"Finger0", "Finger1", "Finger4"}) {
    append(skeleton, std::string("Bip01 L ") + bone, "Bip01 L Hand", {0.03, 0, 0});
    append(skeleton, std::string("Bip01 L ") + bone + "1", std::string("Bip01 L ") + bone, {0.03, 0, 0});
  }
  const Names named = named_bones(skeleton, find_role_map(skeleton));
  EXPECT_EQ(named.at("left_thumb_2"), "Bip01 L Finger01");
  EXPECT_EQ(named.at("left_index_1"), "Bip01 L Finger1");
  EXPECT_EQ(named.at("left_index_2"), "Bip01 L Finger11");
  EXPECT_EQ(named.at("left_pinky_1"), "Bip01 L Finger4");
}

TEST(RoleMap, CountsFingersThatHaveTwoDigitsFromZero) {
  Skeleton skeleton = Humanoid(family_named("Biped")).skeleton;
  for (const char* number : {"00", "01", "02", "03", "04"}) {
    append(skeleton, std::string("Bip01 L Finger") + number, "Bip01 L Hand", {0.03, 0, 0});
  }
  const Names named = named_bones(skeleton, find_role_map(skeleton));
  EXPECT_EQ(named.at("left_thumb_1"), "Bip01 L Finger00");
  EXPECT_EQ(named.at("left_index_1"), "Bip01 L Finger01");
  EXPECT_EQ(named.at("left_pinky_1"), "Bip01 L Finger04");
}

TEST(RoleMap, AFootThatHangsOnAnAnkleBeginsAtTheBall) {
  Humanoid man(family_named("Second Life"));
  for (const std::string side : {"Left", "Right"}) {
    add_bone(man.skeleton, "mToe" + side, man.skeleton.find("mFoot" + side), {0, -0.06, 0}, {0, -0.03, 0});
  }
  const RoleMap map = find_role_map(make_skeleton(man.skeleton));
  EXPECT_EQ(man.skeleton.names[map.bone(Role::kToe, Side::kLeft)], "mFootLeft");
  EXPECT_EQ(man.skeleton.names[map.bone(Role::kFoot, Side::kLeft)], "mAnkleLeft");
}

TEST(RoleMap, AFootOnWhichNothingHangsGivesWayToTheOneBesideIt) {
  Skeleton skeleton = Humanoid(family_named("Unreal")).skeleton;
  for (const std::string side : {"l", "r"}) {
    skeleton.names[skeleton.find("foot_" + side)] = "joint_" + side;
    append(skeleton, "foot_" + side, "calf_" + side, skeleton.offsets[skeleton.find("joint_" + side)]);
  }
  const Names named = named_bones(skeleton, find_role_map(skeleton));
  for (const std::string side : {"l", "r"}) {
    const std::string word = side == "l" ? "left" : "right";
    EXPECT_EQ(named.at(word + "_foot"), "joint_" + side);
    EXPECT_EQ(named.at(word + "_toe"), "ball_" + side);
  }
}

TEST(RoleMap, HipsBesideATorsoGiveWayToWhatCarriesBoth) {
  Skeleton skeleton = Humanoid(family_named("Unreal")).skeleton;
  const int torso = skeleton.find("pelvis"), hips = torso + 1;
  const auto insert = [&](auto& of_each, const auto& what) { of_each.insert(of_each.begin() + hips, what); };
  for (int& parent : skeleton.parents) parent += parent >= hips;
  insert(skeleton.parents, torso);
  insert(skeleton.offsets, Vector3{Vector3::Zero()});
  insert(skeleton.rest_rotations, Quaternion{Quaternion::Identity()});
  insert(skeleton.tips, Vector3{skeleton.tips[torso]});
  insert(skeleton.names, std::string("pelvis"));
  skeleton.names[torso] = "torso";
  for (const std::string thigh : {"thigh_l", "thigh_r"}) skeleton.parents[skeleton.find(thigh)] = hips;
  const Names named = named_bones(skeleton, find_role_map(skeleton));
  EXPECT_EQ(named.at("hips"), "torso");
  EXPECT_EQ(named.at("left_thigh"), "thigh_l");
}

TEST(RoleMap, AFootThatCarriesNoSkinGivesWayToTheOneBesideItThatDoes) {
  Skeleton skeleton = Humanoid(family_named("Unreal")).skeleton;
  for (const std::string side : {"l", "r"}) {  // with toes of its own, as a chain of controls has them
    const int real = skeleton.find("foot_" + side);
    skeleton.names[real] = "joint_" + side;
    append(skeleton, "foot_" + side, "calf_" + side, skeleton.offsets[real]);
    append(skeleton, "toes_" + side, "foot_" + side, Vector3{0, 0.1, 0});
  }
  Skin skin;
  skin.points.assign(1, Vector3::Zero());
  const auto foot = [&](const Skin* known) {
    return named_bones(skeleton, find_role_map(skeleton, nullptr, Sides::of_the_body, known)).at("left_foot");
  };
  EXPECT_EQ(foot(nullptr), "foot_l");
  EXPECT_EQ(foot(&skin), "foot_l") << "a skin without weights tells nothing";
  for (const std::string name : {"pelvis", "ball_l", "ball_r"}) skin.weights.push_back({0, skeleton.find(name), 1});
  EXPECT_EQ(foot(&skin), "joint_l");
  skin.weights.push_back({0, skeleton.find("toes_l"), 0.1});
  EXPECT_EQ(foot(&skin), "foot_l");
}

// As MMD's models have them.
TEST(RoleMap, ALegWhoseFootCarriesNoSkinGivesWayToItsCopyThatDoes) {
  Skeleton skeleton = Humanoid(family_named("MMD")).skeleton;
  const auto copy = [&](const std::string& name, const std::string& parent) {
    append(skeleton, name + "D", parent, skeleton.offsets[skeleton.find(name)]);
  };
  for (const std::string side : {"左", "右"}) {
    copy(side + "足", skeleton.names[skeleton.parents[skeleton.find(side + "足")]]);
    copy(side + "ひざ", side + "足D");
    copy(side + "足首", side + "ひざD");
  }
  const auto leg = [&](const Skin* skin) {
    const Names named = named_bones(skeleton, find_role_map(skeleton, nullptr, Sides::of_the_body, skin));
    return named.at("left_thigh") + " " + named.at("left_shin") + " " + named.at("right_foot");
  };
  EXPECT_EQ(leg(nullptr), "左足 左ひざ 右足首");
  Skin skin;
  skin.points.assign(1, Vector3::Zero());
  for (const std::string name : {"左足", "左足首D", "右足首D"}) skin.weights.push_back({0, skeleton.find(name), 1});
  EXPECT_EQ(leg(&skin), "左足D 左ひざD 右足首D");
  for (const std::string name : {"左足首", "右足首"}) skin.weights.push_back({0, skeleton.find(name), 1});
  EXPECT_EQ(leg(&skin), "左足 左ひざ 右足首") << "where both carry skin names tell";
}

// As Quaternius' dinosaurs have them, whose arms are called legs.
// Legs alone are no body that its shape tells; it faces -y. Tips that go on down the leg tell nothing.
TEST(RoleMap, TellsSidesByTheFeetWhereNamesHaveThemTheWrongWayRound) {
  const auto left_foot = [](double side, const Vector3& tip) {
    Skeleton s;
    const auto add = [&](const std::string& name, int parent, const Vector3& offset, const Vector3& tip) {
      s.names.push_back(name), s.parents.push_back(parent), s.offsets.push_back(offset), s.tips.push_back(tip);
    };
    add("hips", -1, {0, 0, 1}, {0, 0, 0.2});
    add("head", 0, {0, 0, 0.5}, {0, 0, 0.2});
    for (const std::string end : {".L", ".R"}) {
      const int thigh = s.size();
      add("thigh" + end, 0, {end == ".L" ? side : -side, 0, 0}, {0, 0, -0.5});
      add("shin" + end, thigh, {0, 0, -0.5}, {0, 0, -0.4});
      add("foot" + end, thigh + 1, {0, 0, -0.4}, tip);
    }
    s.rest_rotations.assign(s.size(), Quaternion::Identity());
    return named_bones(s, find_role_map(s)).at("left_foot");
  };
  EXPECT_EQ(left_foot(0.1, {0, -0.2, -0.1}), "foot.L");
  EXPECT_EQ(left_foot(-0.1, {0, -0.2, -0.1}), "foot.R");
  EXPECT_EQ(left_foot(-0.1, {0, -0.1, -0.2}), "foot.L");
}

TEST(RoleMap, OfABeastWithHindLegsItsOtherLegsAreNoLegs) {
  Skeleton skeleton = dog();
  skeleton.roles = {};
  skeleton.names = {"Body", "Torso", "Head"};
  for (const std::string limb : {"Front", "Back"}) {
    for (const std::string side : {".L", ".R"}) {
      for (const std::string part : {"UpLeg", "LowLeg", "Foot"}) skeleton.names.push_back(limb + part + side);
    }
  }
  for (int b = 0; b < skeleton.size(); ++b) {
    if (skeleton.names[b].rfind("Front", 0) == 0 && skeleton.parents[b] != 0) skeleton.offsets[b] *= 0.3;
  }
  const Skeleton beast = make_skeleton(skeleton);
  EXPECT_EQ(beast.names[beast.roles.left_foot], "BackFoot.L");
  EXPECT_EQ(beast.names[beast.roles.right_foot], "BackFoot.R");
  EXPECT_EQ(beast.names[beast.roles.left_thigh], "BackUpLeg.L");
  EXPECT_EQ(beast.roles.left_fore_foot, -1);
}

// "Leg:Left:Upper" and "Arm:Left:Upper" differ ahead of the last mark alone.
TEST(RoleMap, ReadsWholeNamesWhereWhatLooksLikeANamespaceTellsBonesApart) {
  Family family = family_named("Mixamo");
  family.others.clear();
  family.arm = {"Arm:@:Shoulder", "Arm:@:Upper", "Arm:@:Lower", "Arm:@:Hand"};
  family.leg = {"Leg:@:Upper", "Leg:@:Lower", "Leg:@:Foot", "Leg:@:Toe"};
  const Humanoid body(family);
  EXPECT_EQ(named_bones(body.skeleton, find_role_map(make_skeleton(body.skeleton))), body.roles);
}

TEST(RoleMap, OfAUserIsKept) {
  const Humanoid body(family_named("Daz"));
  const RoleMap map = role_map_of(body.skeleton, body.roles);
  EXPECT_EQ(named_bones(body.skeleton, map), body.roles);
  EXPECT_EQ(map.confidence(Role::kHead), 1);
  const auto error = [&](const Names& roles) { return error_of([&] { role_map_of(body.skeleton, roles); }); };
  EXPECT_NE(error({{"hat", "head"}}).find("no role 'hat'; the roles are root, hips"), std::string::npos);
  EXPECT_NE(error({{"head", "Kopf"}}).find("role 'head': there is no bone 'Kopf'"), std::string::npos);
  EXPECT_NE(error({{"head", "hip"}, {"hips", "hip"}}).find("bone 'hip' has two roles"), std::string::npos);
}

TEST(RoleMap, OfAsManyBonesAsAreAllowedIsNoError) {
  Skeleton wide, deep;
  for (int b = 0; b < 4096; ++b) {
    for (Skeleton* skeleton : {&wide, &deep}) {
      add_bone(*skeleton, "foot" + std::to_string(b) + "_L", (skeleton == &wide ? std::min(b, 1) : b) - 1,
               {0.001 * b, 0, 0.1}, {0, 0, 0.1});
    }
  }
  EXPECT_NO_THROW(make_skeleton(wide));
  EXPECT_NO_THROW(make_skeleton(deep));
}

}  // namespace
}  // namespace fragmotion

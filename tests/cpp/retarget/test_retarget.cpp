// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "add_bone.hpp"
#include "dog.hpp"
#include "humanoids.hpp"
#include "mocap_files.hpp"
#include "retarget/retarget.hpp"
#include "skeleton/roles.hpp"
#include "walker.hpp"

namespace fragmotion {
namespace {

using Places = std::vector<Vector3>;

std::vector<Clip> takes() { return gait_takes(60); }

Body body_of(const Skeleton& skeleton) { return make_body(skeleton, find_role_map(skeleton)); }

Places places(const Skeleton& skeleton, const Clip& clip) {
  const Kinematics kinematics(skeleton);
  PosedBones posed(skeleton.size());
  Places all;
  for (int f = 0; f < clip.frames; ++f) {
    world(kinematics, clip, f, posed.heads.data(), posed.rotations.data());
    all.insert(all.end(), posed.heads.begin(), posed.heads.end());
  }
  return all;
}

double farthest(const Places& a, const Places& b, double scale) {
  double most = 0;
  for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, (scale * a[i] - b[i]).norm() / scale);
  return most;
}

// How far joints are from those of the source after each take is brought onto another skeleton of the same body.
double joint_error(const Skeleton& target, double scale = 1) {
  const Skeleton source = humanoid();
  const Retarget retarget(body_of(source), body_of(target));
  double most = 0;
  for (const Clip& clip : takes()) {
    most = std::max(most, farthest(places(source, clip), places(target, retarget.apply(clip).clip), scale));
  }
  return most;
}

// The skeleton with each bone's frame turned within the bone.
Skeleton rolled(Skeleton skeleton) {
  Random random(7);
  std::vector<Quaternion> rolls;
  for (int b = 0; b < skeleton.size(); ++b) {
    rolls.push_back(Quaternion(random.uniform() - 0.5, random.uniform(), random.uniform(), 0.3).normalized());
  }
  for (int b = 0; b < skeleton.size(); ++b) {
    skeleton.tips[b] = rolls[b].conjugate() * skeleton.tips[b];
    const int parent = skeleton.parents[b];
    skeleton.rest_rotations[b] = skeleton.rest_rotations[b] * rolls[b];
    if (parent < 0) continue;
    skeleton.rest_rotations[b] = rolls[parent].conjugate() * skeleton.rest_rotations[b];
    skeleton.offsets[b] = rolls[parent].conjugate() * skeleton.offsets[b];
  }
  return skeleton;
}

// The skeleton with a bone, and all that hangs on it, turned at rest about the forward axis.
Skeleton turned_at_rest(Skeleton skeleton, const std::string& bone, double angle) {
  Quaternion& rest = skeleton.rest_rotations[skeleton.find(bone)];
  rest = rest * Eigen::AngleAxisd(angle, Vector3::UnitY());
  return skeleton;
}

Skeleton in_t_pose() {
  return turned_at_rest(turned_at_rest(humanoid(), "upper_arm.L", -kPi / 2), "upper_arm.R", kPi / 2);
}

// Other lengths of thighs, shins (and feet with them), trunk and hips, on the ground as before.
Skeleton proportioned(double thigh, double shin, double trunk, double wide) {
  Skeleton skeleton = humanoid();
  const auto offset = [&](const char* name) -> Vector3& { return skeleton.offsets[skeleton.find(name)]; };
  offset("spine") *= trunk;
  offset("head") *= trunk;
  for (const char* end : {".L", ".R"}) {
    offset((std::string("thigh") + end).c_str()).x() *= wide;
    offset((std::string("shin") + end).c_str()) *= thigh;
    offset((std::string("foot") + end).c_str()) *= shin;
    skeleton.tips[skeleton.find(std::string("foot") + end)] *= (thigh + shin) / 2;
  }
  skeleton.offsets[0].z() += 0.44 * (thigh - 1) + 0.42 * (shin - 1) + 0.08 * ((thigh + shin) / 2 - 1);
  return skeleton;
}

TEST(Retarget, OntoItselfChangesNothing) { EXPECT_LT(joint_error(humanoid()), 1e-6); }

TEST(Retarget, BoneRollsDoNotMatter) { EXPECT_LT(joint_error(rolled(humanoid())), 1e-5); }

TEST(Retarget, ScaleOnlyScales) { EXPECT_LT(joint_error(humanoid(100), 100), 1e-6); }

TEST(Retarget, HowTheArmsAreHeldAtRestDoesNotMatter) {
  EXPECT_LT(joint_error(in_t_pose()), 1e-5);
  EXPECT_LT(joint_error(rolled(turned_at_rest(in_t_pose(), "upper_arm.L", 0.7))), 1e-5);
  EXPECT_LT(joint_error(turned_at_rest(in_t_pose(), "forearm.R", 0.5)), 1e-5);
}

TEST(Retarget, WhereTheBodyFacesAtRestDoesNotMatter) {
  Skeleton turned = humanoid();
  turned.rest_rotations[0] = Quaternion(Eigen::AngleAxisd(2, Vector3::UnitZ()));
  EXPECT_LT(joint_error(turned), 1e-5);
}

TEST(Retarget, ABodyThatLiesAtRestIsRighted) {
  Skeleton lying = humanoid();
  lying.rest_rotations[0] = Quaternion(Eigen::AngleAxisd(kPi / 2, Vector3::UnitX()));
  EXPECT_LT(joint_error(lying), 1e-5);
}

TEST(Retarget, NamesDoNotMatter) {
  const Skeleton source = humanoid();
  Skeleton target = source;
  std::map<std::string, std::string> bones = named_bones(source, find_role_map(source));
  for (int b = 0; b < target.size(); ++b) target.names[b] = "Bone" + std::to_string(b);
  for (auto& [role, bone] : bones) bone = target.names[source.find(bone)];
  const Retarget retarget(body_of(source), make_body(target, role_map_of(target, bones)));
  for (const Clip& clip : takes()) {
    EXPECT_LT(farthest(places(source, clip), places(target, retarget.apply(clip).clip), 1), 1e-6);
  }
}

TEST(Retarget, FeetAndKneesKeepTheirMannersOnOtherProportions) {
  const std::vector<Skeleton> targets{humanoid(0.6),
                                      humanoid(1.6),
                                      proportioned(0.75, 0.75, 1.2, 1),
                                      proportioned(1.3, 1.3, 0.9, 1),
                                      proportioned(0.85, 1.2, 1, 1),
                                      proportioned(1.2, 0.8, 1, 1),
                                      proportioned(1, 1, 1, 1.8),
                                      proportioned(1.1, 0.9, 0.8, 0.6)};
  for (std::size_t i = 0; i < targets.size(); ++i) {
    const Retarget retarget(body_of(humanoid()), body_of(targets[i]));
    for (const Clip& clip : takes()) {
      const RetargetReport report = retarget.apply(clip).report;
      EXPECT_LT(report.foot_skate_ratio, 1.1) << i << " " << clip.name;
      EXPECT_LT(report.contact_error, 0.01) << i << " " << clip.name;
      EXPECT_LT(report.knee_beyond, 1e-6) << i << " " << clip.name;
    }
  }
}

TEST(Retarget, FeetOfNoKnownLengthAreTakenForUsualOnes) {
  Skeleton target = humanoid();
  for (const char* foot : {"foot.L", "foot.R"}) target.tips[target.find(foot)] *= 4;
  const Retarget retarget(body_of(humanoid()), body_of(target));
  for (const Clip& clip : takes()) {
    EXPECT_LT(retarget.apply(clip).report.hips_moved, 0.01) << clip.name;
    EXPECT_LT(retarget.apply(clip).report.contact_error, 0.01) << clip.name;
  }
}

TEST(Retarget, ThereAndBackAgainIsTheSame) {
  const Skeleton source = humanoid(), other = rolled(proportioned(1.2, 1.15, 0.8, 1));
  const Retarget there(body_of(source), body_of(other)), back(body_of(other), body_of(source));
  double sum = 0, count = 0;
  for (const Clip& clip : takes()) {
    const Clip again = back.apply(there.apply(clip).clip).clip;
    for (std::size_t i = 0; i < clip.rotations.size(); i += 4, ++count) {
      sum += load_quaternion(&clip.rotations[i]).angularDistance(load_quaternion(&again.rotations[i]));
    }
  }
  EXPECT_LT(sum / count, 2 * kPi / 180);
}

TEST(Retarget, TheReportIsTrueOfTheClip) {
  const Skeleton target = proportioned(0.8, 1.1, 1, 1.4);
  const Retarget retarget(body_of(humanoid()), body_of(target));
  const Clip clip = gait_clip({});
  const RetargetedClip result = retarget.apply(clip);
  EXPECT_NEAR(retarget.scale(), (0.44 * 0.8 + 0.42 * 1.1) / 0.86, 1e-9);
  EXPECT_EQ(result.clip.frames, clip.frames);
  EXPECT_EQ(result.clip.name, clip.name);
  const Contacts contacts = find_contacts(Kinematics(humanoid()), clip);
  const Places mine = places(target, result.clip), theirs = places(humanoid(), clip);
  const int foot = target.find("foot.L");
  for (int f = 1; f < clip.frames; ++f) {
    if (!contacts.feet[0][f] || !contacts.feet[0][f - 1]) continue;
    const Vector3 &now = mine[f * target.size() + foot], &before = mine[(f - 1) * target.size() + foot];
    const Vector3 &source = theirs[f * target.size() + foot], &earlier = theirs[(f - 1) * target.size() + foot];
    EXPECT_LT((now - before).norm(), retarget.scale() * (source - earlier).norm() + 1e-3) << f;
  }
}

TEST(Retarget, ThreadsChangeNoBit) {
  const Retarget retarget(body_of(humanoid()), body_of(proportioned(0.9, 1.2, 1, 1.2)));
  const std::vector<RetargetedClip> one = retarget.apply(takes(), 1), three = retarget.apply(takes(), 3);
  ASSERT_EQ(one.size(), three.size());
  for (std::size_t c = 0; c < one.size(); ++c) EXPECT_EQ(one[c].clip.rotations, three[c].clip.rotations);
}

// A body whose trunk has `spines` bones of one length, in a straight line.
Skeleton with_spines(int spines) {
  Skeleton skeleton = humanoid();
  const int chest = skeleton.find("spine");
  Skeleton made;
  std::vector<int> index(skeleton.size());
  const auto add = [&](const std::string& name, int parent, const Vector3& offset, const Vector3& tip) {
    return add_bone(made, name, parent, offset, tip);
  };
  for (int b = 0; b < skeleton.size(); ++b) {
    int parent = b == 0 ? -1 : index[skeleton.parents[b]];
    const Vector3 offset = b == chest ? Vector3{skeleton.offsets[b] / spines} : skeleton.offsets[b];
    for (int s = 1; b == chest && s < spines; ++s) {
      parent = add("spine" + std::to_string(s), parent, offset, offset);
    }
    index[b] = add(b == chest ? "spine" + std::to_string(spines) : skeleton.names[b], parent, offset, skeleton.tips[b]);
  }
  return make_skeleton(made);
}

TEST(Retarget, ABentTrunkIsSpreadOverMoreBones) {
  const Skeleton source = with_spines(1), target = with_spines(4);
  Clip clip = gait_clip({});
  const Quaternion bent(Eigen::AngleAxisd(0.8, Vector3::UnitX()));
  for (int f = 0; f < clip.frames; ++f) store_quaternion(bent, &clip.rotations[4 * (f * source.size() + 1)]);
  const Clip result = Retarget(body_of(source), body_of(target)).apply(clip).clip;
  for (int s = 1; s <= 4; ++s) {
    const int bone = target.find("spine" + std::to_string(s));
    const Quaternion part = load_quaternion(&result.rotations[4 * bone]);
    EXPECT_NEAR(part.angularDistance(Quaternion(Eigen::AngleAxisd(0.2, Vector3::UnitX()))), 0, 1e-6) << s;
  }
}

TEST(Retarget, TwistBonesHaveTheirShareOfTheHandsTurn) {
  const Skeleton source = humanoid();
  Skeleton target = source;
  const int forearm = target.find("forearm.L");
  add_bone(target, "forearm_twist.L", forearm, {0, 0, -0.125}, {0, 0, -0.1});
  target = make_skeleton(target);
  RoleMap map = find_role_map(source);
  map.twists = {{target.size() - 1, forearm, 0.5}};
  Clip clip = gait_clip({});
  const Quaternion twist(Eigen::AngleAxisd(1, Vector3::UnitZ()));
  for (int f = 0; f < clip.frames; ++f) {
    store_quaternion(twist, &clip.rotations[4 * (f * source.size() + source.find("hand.L"))]);
  }
  const Clip result = Retarget(body_of(source), make_body(target, map)).apply(clip).clip;
  const Quaternion half = load_quaternion(&result.rotations[std::size_t{4} * (target.size() - 1)]);
  EXPECT_NEAR(half.angularDistance(Quaternion(Eigen::AngleAxisd(0.5, Vector3::UnitZ()))), 0, 1e-6);
}

TEST(Retarget, ABodyWithoutArmsOrNeckIsDriven) {
  const Skeleton target = humanoid();
  RoleMap map = find_role_map(target);
  const auto above = [](const RoleBone& b) {
    return b.role == Role::kUpperArm || b.role == Role::kLowerArm || b.role == Role::kHand || b.role == Role::kHead;
  };
  map.bones.erase(std::remove_if(map.bones.begin(), map.bones.end(), above), map.bones.end());
  const Clip clip = gait_clip({});
  const Clip result = Retarget(body_of(humanoid()), make_body(target, map)).apply(clip).clip;
  const std::size_t arm = 4 * target.find("upper_arm.L"), leg = 4 * target.find("thigh.L");
  EXPECT_EQ(load_quaternion(&result.rotations[arm]).w(), 1);
  EXPECT_NEAR(load_quaternion(&result.rotations[leg]).angularDistance(load_quaternion(&clip.rotations[leg])), 0, 1e-6);
}

TEST(Body, SaysWhatIsMissing) {
  const Skeleton skeleton = humanoid();
  const auto without = [&](const std::function<bool(const RoleBone&)>& gone) {
    RoleMap map = find_role_map(skeleton);
    map.bones.erase(std::remove_if(map.bones.begin(), map.bones.end(), gone), map.bones.end());
    return error_of([&] { make_body(skeleton, map); });
  };
  EXPECT_NE(without([](const RoleBone& b) { return b.role == Role::kHips; }).find("hips:"), std::string::npos);
  EXPECT_NE(
      without([](const RoleBone& b) { return b.role == Role::kShin && b.side == Side::kLeft; }).find("left_shin:"),
      std::string::npos);
  EXPECT_NE(without([](const RoleBone&) { return true; }).find("hips, left_thigh, left_shin"), std::string::npos);
}

TEST(Body, SaysWhatHangsWrong) {
  const Skeleton skeleton = humanoid();
  RoleMap map = find_role_map(skeleton);
  for (RoleBone& bone : map.bones) {
    if (bone.role == Role::kShin) bone.bone = skeleton.find(bone.side == Side::kLeft ? "shin.R" : "shin.L");
  }
  EXPECT_NE(error_of([&] { make_body(skeleton, map); }).find("left_shin 'shin.R' does not hang on left_thigh"),
            std::string::npos);
}

TEST(Body, HasNoToeThatDoesNotHangFromItsFoot) {
  Skeleton skeleton = make_skeleton(Humanoid(families()[2]).skeleton);
  RoleMap map = find_role_map(skeleton);
  ASSERT_GE(make_body(skeleton, map).legs[0].toe, 0);
  for (RoleBone& bone : map.bones) {
    if (bone.role == Role::kToe) bone.bone = bone.side == Side::kLeft ? 0 : skeleton.roles.left_foot;
  }
  for (const Leg& leg : make_body(skeleton, map).legs) EXPECT_EQ(leg.toe, -1);
}

TEST(Body, OneBoneIsNone) {
  Skeleton one;
  one.names = {"bone"};
  one.parents = {-1};
  one.rest_rotations = {Quaternion::Identity()};
  one.offsets = {Vector3::Zero()};
  one.tips = {Vector3::UnitZ()};
  one = make_skeleton(one);
  EXPECT_NE(error_of([&] { body_of(one); }).find("left_thigh"), std::string::npos);
}

TEST(Body, OfNoStandingRestPoseIsToldByItsClips) {
  Skeleton folded = humanoid();
  const Quaternion up(Eigen::AngleAxisd(kPi, Vector3::UnitX()));
  std::vector<Clip> clips = takes();
  for (const char* name : {"thigh.L", "thigh.R"}) folded.rest_rotations[folded.find(name)] = up;
  const Body guessed = body_of(folded), told = make_body(folded, find_role_map(humanoid()), clips);
  EXPECT_FALSE(guessed.stands);
  EXPECT_TRUE(told.stands);
  EXPECT_NE(error_of([&] { Retarget(guessed, body_of(proportioned(1.2, 1, 1, 1))); }).find("rest pose"),
            std::string::npos);
  const Body plain = body_of(humanoid());
  for (int b = 0; b < folded.size(); ++b) {
    EXPECT_LT(told.reference[b].angularDistance(plain.reference[b]), 6 * kPi / 180) << folded.names[b];
  }
}

TEST(Body, OfNoStandingRestPoseLooksStraightAheadOnTheMean) {
  Skeleton folded = humanoid();
  for (const char* name : {"thigh.L", "thigh.R"}) {
    folded.rest_rotations[folded.find(name)] = Quaternion(Eigen::AngleAxisd(kPi, Vector3::UnitX()));
  }
  const int head = folded.find("head");
  const Quaternion bowed(Eigen::AngleAxisd(0.5, Vector3::UnitX()));  // as bones of an actor's neck stand to his back
  std::vector<Clip> clips = takes();
  for (Clip& clip : clips) {
    for (int f = 0; f < clip.frames; ++f) {
      double* stored = &clip.rotations[4 * (static_cast<std::size_t>(f) * folded.size() + head)];
      store_quaternion(load_quaternion(stored) * bowed, stored);
    }
  }
  const Body told = make_body(folded, find_role_map(humanoid()), clips), plain = body_of(humanoid());
  EXPECT_LT(told.reference[head].angularDistance(plain.reference[head] * bowed), 6 * kPi / 180);
}

// As blocky characters have them.
Skeleton without_feet() {
  Skeleton skeleton = humanoid();
  for (const char* end : {".L", ".R"}) {
    const int foot = skeleton.find(std::string("foot") + end), shin = skeleton.find(std::string("shin") + end);
    skeleton.tips[shin] = skeleton.offsets[foot] + Vector3{0, 0, -0.07};
    skeleton.names.erase(skeleton.names.begin() + foot);
    skeleton.parents.erase(skeleton.parents.begin() + foot);
    skeleton.offsets.erase(skeleton.offsets.begin() + foot);
    skeleton.tips.erase(skeleton.tips.begin() + foot);
    skeleton.rest_rotations.erase(skeleton.rest_rotations.begin() + foot);
    for (int& parent : skeleton.parents) parent -= parent > foot ? 1 : 0;
  }
  skeleton.roles = {};
  return make_skeleton(skeleton);
}

TEST(Retarget, LegsWithoutFeetStandOnTheirShins) {
  const Skeleton target = without_feet();
  const Body body = body_of(target);
  EXPECT_EQ(body.own_skeleton().names, target.names);
  const Retarget retarget(body_of(humanoid()), body);
  for (const Clip& clip : takes()) {
    const RetargetedClip result = retarget.apply(clip);
    EXPECT_EQ(result.clip.rotations.size(), std::size_t{4} * target.size() * clip.frames);
    EXPECT_LT(result.report.contact_error, 0.01) << clip.name;
    EXPECT_LT(result.report.knee_beyond, 1e-6) << clip.name;
  }
  EXPECT_NE(error_of([&] { Retarget(body, body_of(humanoid())); }).find("have no feet"), std::string::npos);
}

// As some systems have them: of an ankle from which a stub leads down to a foot that lies on the ground.
TEST(Body, HasTheFootThatLeadsAhead) {
  Skeleton skeleton = humanoid();
  for (const char* end : {".L", ".R"}) {
    const int foot = skeleton.find(std::string("foot") + end);
    skeleton.tips[foot] = {0, 0, -0.08};
    add_bone(skeleton, std::string("toe") + end, foot, {0, 0, -0.08}, {0, -0.2, 0});
  }
  skeleton.roles = {};
  const Skeleton stubbed = make_skeleton(skeleton);
  const Body body = body_of(stubbed);
  for (int side = 0; side < 2; ++side) {
    EXPECT_EQ(stubbed.names[body.legs[side].foot], side == 0 ? "toe.L" : "toe.R");
    EXPECT_GT(body.feet[side].y(), 0.9 * body.feet[side].norm()) << "which points ahead";
  }
}

TEST(Body, StandsOnNoGroundOfFeetThatHang) {
  std::vector<Clip> clips = takes();
  const Body plain = make_body(humanoid(), find_role_map(humanoid()), clips);
  clips.push_back(clips[0]);
  for (std::size_t z = 2; z < clips.back().root_positions.size(); z += 3) clips.back().root_positions[z] += 0.4;
  const Body told = make_body(humanoid(), find_role_map(humanoid()), clips);
  for (int side = 0; side < 2; ++side) {
    EXPECT_NEAR(told.soles[side].ball, plain.soles[side].ball, 1e-3);
    EXPECT_NEAR(told.soles[side].heel, plain.soles[side].heel, 1e-3);
  }
}

// Rotations that were made of joints' places alone leave it open how a bone is turned about its length.
TEST(Body, WhoseKneesBendAsideAtRestIsToldByItsClips) {
  const Skeleton skeleton = humanoid();
  const Quaternion twist(Eigen::AngleAxisd(kPi / 2, Vector3::UnitZ()));
  std::vector<Clip> clips = takes();
  for (Clip& clip : clips) {
    for (int f = 0; f < clip.frames; ++f) {
      for (const char* side : {".L", ".R"}) {
        const auto turn = [&](const std::string& bone, const Quaternion& before, const Quaternion& after) {
          double* own = &clip.rotations[std::size_t{4} * (f * skeleton.size() + skeleton.find(bone + side))];
          store_quaternion(before * load_quaternion(own) * after, own);
        };
        turn("thigh", Quaternion::Identity(), twist);
        turn("shin", twist.conjugate(), twist);
        turn("foot", twist.conjugate(), Quaternion::Identity());
      }
    }
  }
  const Body plain = body_of(skeleton), told = make_body(skeleton, find_role_map(skeleton), clips);
  for (const char* bone : {"thigh.L", "shin.L", "thigh.R", "shin.R"}) {
    const int b = skeleton.find(bone);
    EXPECT_LT(told.reference[b].angularDistance(plain.reference[b] * twist), 6 * kPi / 180) << bone;
  }
}

TEST(Retarget, RefusesAClipOfAnotherSkeleton) {
  const Retarget retarget(body_of(with_spines(3)), body_of(humanoid()));
  EXPECT_NE(error_of([&] { retarget.apply(gait_clip({})); }).find("has not the source's"), std::string::npos);
}

TEST(Retarget, AnimalsAreRefusedByWhatTheyAre) {
  try {
    body_of(dog());
    FAIL() << "a dog is no body with two legs";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("four legs"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace fragmotion

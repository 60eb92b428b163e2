// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "add_bone.hpp"
#include "io/bvh.hpp"
#include "mocap_files.hpp"
#include "motion/mirror.hpp"
#include "rolled_humanoid.hpp"
#include "skeleton/roles.hpp"
#include "small_skeleton.hpp"
#include "walker.hpp"

namespace fragmotion {
namespace {

std::vector<Vector3> tips(const Kinematics& kinematics, const Clip& clip, int frame) {
  std::vector<Vector3> heads(kinematics.bones()), tips;
  std::vector<Quaternion> rotations(kinematics.bones());
  world(kinematics, clip, frame, heads.data(), rotations.data());
  for (int b = 0; b < kinematics.bones(); ++b) tips.push_back(heads[b] + rotations[b] * kinematics.skeleton().tips[b]);
  return tips;
}

// The largest distance of a bone's tip from the reflection of its counterpart's in the original.
double worst_reflection(const Kinematics& kinematics, const Clip& clip, const Clip& mirrored) {
  const std::vector<int> counterpart = mirror_bones(kinematics.skeleton());
  double worst = 0;
  for (int f = 0; f < clip.frames; ++f) {
    const std::vector<Vector3> original = tips(kinematics, clip, f), image = tips(kinematics, mirrored, f);
    for (int b = 0; b < kinematics.bones(); ++b) {
      if (!kinematics.skeleton().is_below(b, kinematics.skeleton().roles.hips)) continue;
      const Vector3 other = original[counterpart[b]];
      worst = std::max(worst, (image[b] - Vector3(-other.x(), other.y(), other.z())).norm());
    }
  }
  return worst;
}

void expect_same(const Clip& a, const Clip& b, double tolerance) {
  ASSERT_EQ(a.frames, b.frames);
  for (std::size_t i = 0; i < a.root_positions.size(); ++i)
    EXPECT_NEAR(a.root_positions[i], b.root_positions[i], tolerance);
  for (std::size_t i = 0; i < a.headings.size(); ++i) EXPECT_NEAR(a.headings[i], b.headings[i], tolerance);
  double worst = 0;
  for (std::size_t i = 0; i < a.rotations.size(); i += 4) {
    worst = std::max(worst, 1 - std::abs(load_quaternion(&a.rotations[i]).dot(load_quaternion(&b.rotations[i]))));
  }
  EXPECT_LT(std::sqrt(worst), tolerance);
}

TEST(Mirror, ReflectsEveryTipOntoItsCounterpart) {
  for (const Skeleton& skeleton : {humanoid(), rolled_humanoid(3), small_skeleton()}) {
    const Kinematics kinematics(skeleton);
    const Clip clip = make_clip(skeleton, random_clip(skeleton, 8, 5));
    const Clip mirrored = Mirror(kinematics, {clip})(clip);
    EXPECT_EQ(mirrored.name, "clip mirrored");
    EXPECT_EQ(mirrored.rate, clip.rate);
    EXPECT_LT(worst_reflection(kinematics, clip, mirrored), 1e-9);
  }
}

// humanoid() with a right thigh that hangs on the spine.
Skeleton with_a_thigh_on_the_spine() {
  Skeleton s = humanoid();
  const int spine = s.find("spine"), thigh = s.find("thigh.R");
  s.parents[thigh] = spine;
  s.offsets[thigh] -= s.offsets[spine];
  return make_skeleton(std::move(s));
}

TEST(Mirror, TurnsNoBonesOneByOneThatHangOtherwiseOnEachSide) {
  const Kinematics one_by_one(humanoid()), other(with_a_thigh_on_the_spine());
  EXPECT_FALSE(Mirror(one_by_one, {}).turns().counterparts.empty());
  EXPECT_TRUE(Mirror(other, {}).turns().counterparts.empty());
}

TEST(Mirror, TwiceIsTheOriginal) {
  for (const Skeleton& skeleton : {humanoid(), rolled_humanoid(4), small_skeleton(), with_a_thigh_on_the_spine()}) {
    const Kinematics kinematics(skeleton);
    const Clip clip = make_clip(skeleton, random_clip(skeleton, 8, 6));
    const Mirror mirror(kinematics, {clip});
    expect_same(mirror(mirror(clip)), clip, 1e-7);
    if (mirror.turns().counterparts.empty()) continue;
    EXPECT_LT(worst_reflection(kinematics, mirror(mirror(clip)), mirror(clip)), 1e-9);
  }
}

// humanoid() with two fingers of two joints at each hand; tells the left ones' first joints.
Skeleton with_fingers_of_its_own(std::vector<int>& left) {
  Skeleton s = humanoid();
  for (const std::string side : {".L", ".R"}) {
    const int hand = static_cast<int>(std::find(s.names.begin(), s.names.end(), "hand" + side) - s.names.begin());
    for (const auto& [finger, aside] : {std::pair<std::string, double>{"index", -0.02}, {"middle", 0.0}}) {
      for (int joint = 1; joint <= 2; ++joint) {
        if (side == ".L" && joint == 1) left.push_back(s.size());
        add_bone(s, finger + "_" + std::to_string(joint) + side, joint == 1 ? hand : s.size() - 1,
                 joint == 1 ? Vector3{0, aside, -0.09} : Vector3{0, 0, -0.04}, {0, 0, -0.04});
      }
    }
  }
  return make_skeleton(std::move(s));
}

TEST(Mirror, LeavesFingersThatNoTakeMovesOnTheirSide) {
  std::vector<int> left;
  const Skeleton skeleton = with_fingers_of_its_own(left);
  const Kinematics kinematics(skeleton);
  Clip clip = make_clip(skeleton, random_clip(skeleton, 8, 5));
  const std::vector<int> counterpart = mirror_bones(skeleton);
  ASSERT_NE(counterpart[left[0]], left[0]);
  const auto rotation = [&](Clip& of, int frame, int bone) {
    return &of.rotations[std::size_t{4} * (frame * skeleton.size() + bone)];
  };
  const Quaternion bent{Eigen::AngleAxisd(0.8, Vector3::UnitX())}, straight = Quaternion::Identity();
  for (int f = 0; f < clip.frames; ++f) {
    store_quaternion(bent, rotation(clip, f, left[0]));
    store_quaternion(straight, rotation(clip, f, counterpart[left[0]]));
  }
  const Mirror mirror(kinematics, {clip});
  Clip image = mirror(clip);
  const MirrorTurns turns = mirror.turns();
  for (int f = 0; f < clip.frames; ++f) {
    EXPECT_LT(load_quaternion(rotation(image, f, left[0])).angularDistance(bent), 1e-9);
    EXPECT_LT(load_quaternion(rotation(image, f, counterpart[left[0]])).angularDistance(straight), 1e-9);
    for (int b = 1; b < skeleton.size(); ++b) {
      const Quaternion q = load_quaternion(rotation(clip, f, turns.counterparts[b]));
      const Quaternion shown = load_quaternion(rotation(image, f, b));
      EXPECT_LT(shown.angularDistance(turns.before[b] * q * turns.after[b]), 1e-6) << skeleton.names[b];
    }
  }
  EXPECT_EQ(turns.counterparts[left[1]], counterpart[left[1]]) << "a finger that a take moves is mirrored";
}

TEST(Mirror, MovesTheOtherHandWhereOneAloneMoves) {
  std::vector<int> left;
  const Skeleton skeleton = with_fingers_of_its_own(left);
  const Kinematics kinematics(skeleton);
  Clip clip = make_clip(skeleton, random_clip(skeleton, 8, 5));
  const int other = mirror_bones(skeleton)[left[0]];
  const std::size_t width = std::size_t{4} * skeleton.size();
  for (int f = 0; f < clip.frames; ++f) {
    store_quaternion(Quaternion::Identity(), &clip.rotations[f * width + std::size_t{4} * left[0]]);
  }
  const Mirror mirror(kinematics, {clip});
  const MirrorTurns turns = mirror.turns();
  EXPECT_EQ(turns.counterparts[left[0]], other);
  EXPECT_EQ(turns.counterparts[other], left[0]);
  const Clip image = mirror(clip);
  const double* moved = &image.rotations[std::size_t{4} * left[0]];
  EXPECT_GT(load_quaternion(moved).angularDistance(load_quaternion(moved + width)), 0.01);
}

// The mean over a walk of a bone's orientation in the world and of its counterpart's mirror image: how far they are
// apart.
double off_its_image(const Skeleton& skeleton, const Clip& clip, int bone) {
  const Kinematics kinematics(skeleton);
  const Clip image = Mirror(kinematics, {clip})(clip);
  std::vector<Vector3> heads(skeleton.size());
  std::vector<Quaternion> own(skeleton.size()), mirrored(skeleton.size());
  double sum = 0;
  for (int f = 0; f < clip.frames; ++f) {
    world(kinematics, clip, f, heads.data(), own.data());
    world(kinematics, image, f, heads.data(), mirrored.data());
    sum += own[bone].angularDistance(mirrored[bone]) / clip.frames;
  }
  return sum;
}

// A clip in all of which a bone is turned about its length.
Clip rolled(const Skeleton& skeleton, Clip clip, int bone, double angle) {
  for (int f = 0; f < clip.frames; ++f) {
    double* rotation = &clip.rotations[4 * (static_cast<std::size_t>(f) * skeleton.size() + bone)];
    const Quaternion roll{Eigen::AngleAxisd(angle, skeleton.tips[bone].normalized())};
    store_quaternion(load_quaternion(rotation) * roll, rotation);
  }
  return clip;
}

TEST(Mirror, RollsABoneAsTheTakesDoThatRollItByHalfATurn) {
  const Skeleton skeleton = humanoid();
  for (const char* name : {"foot.L", "hand.R"}) {
    const int bone = skeleton.find(name);
    const auto off = [&](double angle) {
      return off_its_image(skeleton, rolled(skeleton, gait_clip({}), bone, angle), bone);
    };
    EXPECT_NEAR(off(EIGEN_PI), off(0), 0.1) << name;
    EXPECT_GT(off(1.4), 1.2) << name << " that a joint turns";
  }
}

TEST(Mirror, RollsNoBoneThatCarriesAnotherBesideItsLength) {
  std::vector<int> left;
  const Skeleton skeleton = with_fingers_of_its_own(left);
  const int hand = skeleton.parents[left[0]];
  Skeleton wide = skeleton;
  for (int b = 0; b < wide.size(); ++b) {
    if (wide.parents[b] == hand || wide.parents[b] == mirror_bones(skeleton)[hand]) wide.offsets[b].y() = -0.08;
  }
  Clip still = random_clip(wide, 8, 5);
  for (int i = 0; i < still.frames * wide.size(); ++i)
    store_quaternion(wide.rest_rotations[i % wide.size()], &still.rotations[4 * static_cast<std::size_t>(i)]);
  const Clip clip = make_clip(wide, rolled(wide, still, hand, EIGEN_PI));
  EXPECT_LT(worst_reflection(Kinematics(wide), clip, Mirror(Kinematics(wide), {clip})(clip)), 1e-9);
}

TEST(Mirror, SwapsTheFeetOnTheGround) {
  const Kinematics kinematics(humanoid());
  for (const Clip& clip : gait_takes()) {
    const Contacts original = find_contacts(kinematics, clip),
                   image = find_contacts(kinematics, Mirror(kinematics, {clip})(clip));
    EXPECT_EQ(image.feet[0], original.feet[1]) << clip.name;
    EXPECT_EQ(image.feet[1], original.feet[0]) << clip.name;
  }
}

TEST(Mirror, TurnsOneRotationIntoAnother) {
  for (const Skeleton& skeleton : {humanoid(), rolled_humanoid(3), small_skeleton()}) {
    const Kinematics kinematics(skeleton);
    const Clip clip = make_clip(skeleton, random_clip(skeleton, 8, 5));
    const Mirror mirror(kinematics, {clip});
    const MirrorTurns turns = mirror.turns();
    Clip turned = mirror(clip);
    ASSERT_EQ(turns.counterparts.size(), skeleton.names.size());
    for (std::size_t i = 0; i < clip.rotations.size(); i += 4) {
      const std::size_t bone = i / 4 % skeleton.names.size(), from = i + 4 * (turns.counterparts[bone] - bone);
      store_quaternion(turns.before[bone] * load_quaternion(&clip.rotations[from]) * turns.after[bone],
                       &turned.rotations[i]);
    }
    expect_same(turned, mirror(clip), 1e-7);
  }
}

TEST(Mirror, HasNoTurnsWhereCounterpartsHangOnOtherBones) {
  Skeleton skeleton = humanoid();
  const int arm = skeleton.find("upper_arm.L");
  ASSERT_GE(arm, 0);
  skeleton.parents[arm] = skeleton.roles.hips;
  const Kinematics kinematics(skeleton);
  EXPECT_TRUE(Mirror(kinematics, {make_clip(skeleton, random_clip(skeleton, 8, 5))}).turns().counterparts.empty());
}

TEST(Mirror, MirrorsTheEvidentControl) {
  Gait gait;
  gait.x = 0.6;
  gait.turn = 0.8;
  const Clip clip = gait_clip(gait);
  const FragmentPool pool = gait_pool({clip, Mirror(Kinematics(humanoid()), {clip})(clip)});
  const std::size_t half = pool.fragments.size() / 2;
  ASSERT_EQ(pool.fragments.size(), 2 * half);
  for (std::size_t i = 0; i < half; ++i) {
    const Control &a = pool.fragments[i].evident, &b = pool.fragments[half + i].evident;
    EXPECT_NEAR(a.x, -b.x, 1e-9);
    EXPECT_NEAR(a.y, b.y, 1e-9);
    EXPECT_NEAR(a.turn, -b.turn, 1e-9);
    EXPECT_NEAR(a.jump, b.jump, 1e-9);
  }
}

TEST(Mirror, ReflectsRealTakesWithinTheBonesAsymmetry) {
  const auto files = files_in(shared_mocap() / "bandai-namco", ".bvh");
  if (files.empty()) GTEST_SKIP() << "no motion capture beside the project";
  const Skeleton skeleton = read_bvh(files[0]).skeleton;
  const Kinematics kinematics(skeleton);
  std::vector<Clip> clips;
  for (std::size_t i = 0; i < files.size(); i += 12) clips.push_back(clip_from_take(skeleton, read_bvh(files[i])));
  const Mirror mirror(kinematics, clips);
  double worst = 0;
  for (const Clip& clip : clips) {
    const Clip mirrored = mirror(clip);
    worst = std::max(worst, worst_reflection(kinematics, clip, mirrored));
    expect_same(mirror(mirrored), clip, 1e-6);
  }
  std::cout << clips.size() << " takes, tips off their reflections by at most " << worst << " m\n";
  EXPECT_LT(worst, 0.02);
}

}  // namespace
}  // namespace fragmotion

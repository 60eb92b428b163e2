// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "fragments/borne_gaits.hpp"
#include "measured_clips.hpp"
#include "motion/legs.hpp"
#include "motion/pose.hpp"

namespace fragmotion {
namespace {

constexpr double kRadian = kPi / 180;  // of a degree
constexpr int kBegin = 15, kEnd = 45;  // a cycle of a walk

void turn(Clip& clip, int frame, const char* bone, const Quaternion& by) {
  double* rotation = &clip.rotations[std::size_t{4} * (kSkeleton.size() * frame + kSkeleton.find(bone))];
  store_quaternion(by * load_quaternion(rotation), rotation);
}

// A walk whose thighs go a little about each axis beside, and whose spine is twisted to and fro, rad.
Clip restless(double twist) {
  Clip clip = gait_clip({});
  for (int f = 0; f < clip.frames; ++f) {
    const Quaternion aside{Eigen::AngleAxisd(f / 6 % 2 == 0 ? 0.15 : -0.15, Vector3::Unit(f / 12 % 3))};
    for (const char* thigh : {"thigh.L", "thigh.R"}) turn(clip, f, thigh, aside);
    const Quaternion twisted{Eigen::AngleAxisd(twist * std::sin(0.2 * f), Vector3::UnitZ())};
    for (const char* bone : {"spine", "head"}) turn(clip, f, bone, twisted);
  }
  return make_clip(kSkeleton, clip);
}

// A walk and a restless one, and each once more: no take is beyond the others.
FragmentPool walks(double twist) {
  const Clip walk = gait_clip({});
  return {kSkeleton, {walk, restless(twist), walk, restless(twist)}, {}};
}

GaitEdit towards(double degrees, double speed = 1) {
  GaitEdit edit;
  edit.direction = degrees * kRadian;
  edit.speed = speed;
  return edit;
}

constexpr double kMostHurry = 1.25;

GaitEdit borne(const FragmentPool& pool, const GaitEdit& edit) {
  const Legs legs = find_legs(kKinematics, pool.clips);
  return BorneGaits(kKinematics, legs, pool, kMostHurry).of(pool.clips[0], 0, kBegin, kEnd, edit);
}

double hips(const FragmentPool& pool, const GaitEdit& edit) { return borne(pool, edit).hips; }

// How far thighs and knees are beyond the walks at most in the gait that this edit makes of the first, degrees.
double beyond(const FragmentPool& pool, const GaitEdit& edit) {
  const Legs legs = find_legs(kKinematics, pool.clips);
  const JointRanges ranges({legs[0].thigh, legs[0].knee, legs[1].thigh, legs[1].knee}, pool.clips);
  const Contacts contacts = find_contacts(kKinematics, pool.clips[0]);
  const Clip made = transformed(kKinematics, legs, pool.clips[0], contacts, kBegin, kEnd, kEnd - kBegin, edit);
  double most = 0;
  for (int f = 0; f < made.frames; ++f) {
    most = std::max(most, ranges.excess(&made.rotations[std::size_t{4} * kSkeleton.size() * f]));
  }
  return most / kRadian;
}

TEST(BorneGaits, AreAsTheyWereWhereJointsStayWithinTheTakes) {
  const FragmentPool pool = walks(0.3);
  for (const GaitEdit& edit : {GaitEdit{}, towards(0, 0.6), towards(0, 1.6), towards(10)}) {
    EXPECT_EQ(hips(pool, edit), 0);
    EXPECT_EQ(borne(pool, edit).tempo, 1);
  }
}

TEST(BorneGaits, TurnHipsAsFarAsIsNeededAndTheSpineBears) {
  const FragmentPool stiff = walks(0), supple = walks(0.3);
  EXPECT_LT(std::abs(hips(stiff, towards(40))), 2.5 * kRadian) << "a degree of each bone of the spine";
  GaitEdit edit = towards(40);
  const double much = hips(supple, edit), before = beyond(supple, edit);
  EXPECT_GT(much, 4 * kRadian);
  edit.hips = much;
  EXPECT_LT(beyond(supple, edit), 3);
  EXPECT_GT(before, 3);
  EXPECT_NEAR(hips(supple, towards(-40)), -much, 4 * kRadian) << "what is restless is not quite its mirror image";
}

TEST(BorneGaits, KeepTheHeadOverHipsThatTurn) {
  const FragmentPool pool = walks(0.3);
  const Legs legs = find_legs(kKinematics, pool.clips);
  const Contacts contacts = find_contacts(kKinematics, pool.clips[0]);
  GaitEdit edit = towards(40);
  const auto world = [&](const char* bone) {
    const Clip made = transformed(kKinematics, legs, pool.clips[0], contacts, kBegin, kEnd, kEnd - kBegin, edit);
    PosedBones posed(kSkeleton.size());
    fragmotion::world(kKinematics, made, 7, posed.heads.data(), posed.rotations.data());
    return posed.rotations[kSkeleton.find(bone)];
  };
  const Quaternion head = world("head"), hips = world("hips");
  edit.hips = 0.3;
  EXPECT_LT(world("head").angularDistance(head), 1e-6);
  EXPECT_NEAR((world("hips") * hips.conjugate()).angularDistance(Quaternion{Eigen::AngleAxisd(0.3, Vector3::UnitZ())}),
              0, 1e-6);
}

TEST(BorneGaits, HurryAsFarAsIsNeededWhereHipsDoNotHelp) {
  const GaitEdit wide = towards(90, 1.5);
  const FragmentPool pool = walks(0);
  const GaitEdit much = borne(pool, wide);
  EXPECT_NEAR(much.tempo, kMostHurry, 1e-9);
  EXPECT_NEAR(much.speed * much.tempo, 1.5, 1e-9) << "as fast as before";
  EXPECT_LT(beyond(pool, much), beyond(pool, wide) - 3);
  const auto tempo_where_takes_step = [&](double speed) {
    FragmentPool aside = pool;
    const Legs legs = find_legs(kKinematics, pool.clips);
    aside.clips.push_back(transformed(kKinematics, legs, pool.clips[0], {}, kBegin, kEnd, 40, towards(90, speed)));
    return borne(aside, wide).tempo;
  };
  EXPECT_EQ(tempo_where_takes_step(1.6), 1);
  EXPECT_NEAR(tempo_where_takes_step(1.3), 1.5 / 1.3, 0.1);
}

}  // namespace
}  // namespace fragmotion

// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "add_bone.hpp"
#include "feet/foot_lock.hpp"
#include "feet/standing_leg.hpp"
#include "motion/legs.hpp"
#include "motion/trunk.hpp"
#include "walker.hpp"

namespace fragmotion {
namespace {

constexpr double kFrame = 1.0 / 60;

// A frame with feet on the ground or not, at whatever height.
Contacts standing(bool left, bool right = false) {
  Contacts contacts;
  contacts.feet = {std::vector<bool>{left}, std::vector<bool>{right}};
  contacts.floors.fill({1, 1});
  return contacts;
}

// A standing body that is carried along at a speed, its feet planted for a while.
struct Carried {
  Skeleton skeleton = humanoid();
  Kinematics kinematics{skeleton};
  Clip clip = gait_clip({0, 0, 0});
  Legs legs = find_legs(kinematics, {clip});
  FootLock lock{kinematics, legs};
  double speed = 0.3;     // m/s
  bool on_floor = false;  // its feet stand where they are lowest in the clip, not at whatever height

  // The world after a frame's pose went through the lock.
  PosedBones posed(int frame, Contacts contacts) {
    WorldPose pose{load_vector(clip.root_positions.data()), clip.headings[0], {}};
    pose.root.y() += speed * frame * kFrame;
    pose.rotations.assign(clip.rotations.begin(), clip.rotations.begin() + std::ptrdiff_t{4} * skeleton.size());
    if (on_floor) contacts.floors = find_contacts(kinematics, clip).floors;
    lock.apply(pose, contacts, {}, frame == 0 ? 0 : kFrame);
    PosedBones posed(skeleton.size());
    kinematics.world(pose.root, pose.rotations.data(), posed.heads.data(), posed.rotations.data());
    return posed;
  }

  Vector3 shown(int frame, bool planted) { return ball(skeleton, legs[0], posed(frame, standing(planted))); }
};

TEST(FootLock, KeepsAPlantedFootWhereItIs) {
  Carried body;
  const Vector3 place = body.shown(0, true);
  for (int f = 1; f < 30; ++f) EXPECT_LT((body.shown(f, true) - place).head<2>().norm(), 5e-3) << f;
  EXPECT_TRUE(body.lock.locked(0));
  EXPECT_FALSE(body.lock.locked(1));
}

// A standing body that turns over its left foot, planted for a while, and then swings it.
struct Turning : Carried {
  double rate = 1;  // rad/s

  // How far the left foot is turned from how it stood at first, rad, and then its thigh.
  std::array<double, 2> turned(int frame, bool planted, const Footwork& work = {}, bool both = false) {
    WorldPose pose{load_vector(clip.root_positions.data()), clip.headings[0] + rate * frame * kFrame, {}};
    pose.rotations.assign(clip.rotations.begin(), clip.rotations.begin() + std::ptrdiff_t{4} * skeleton.size());
    turn_bone(skeleton, skeleton.roles.hips, Vector3::UnitZ(), rate * frame * kFrame, pose.rotations.data());
    lock.apply(pose, standing(planted, both), {}, frame == 0 ? 0 : kFrame, {}, work);
    PosedBones posed(skeleton.size());
    kinematics.world(pose.root, pose.rotations.data(), posed.heads.data(), posed.rotations.data());
    const auto faces = [&](int bone) {
      const Vector3 left = posed.rotations[bone] * Vector3::UnitX();
      return std::atan2(left.y(), left.x());
    };
    if (frame == 0) first_ = {faces(legs[0].foot), faces(legs[0].thigh)};
    return {wrapped(faces(legs[0].foot) - first_[0]), wrapped(faces(legs[0].thigh) - first_[1])};
  }

 private:
  std::array<double, 2> first_{};
};

TEST(FootLock, LetsNoPlantedFootTurnOnTheFloorWithTheBodyAsFarAsItsHipTurns) {
  Turning body;
  const int most = static_cast<int>(kTurnsInHip / kFrame);
  for (int f = 0; f <= most; ++f) {
    const auto [foot, thigh] = body.turned(f, true);
    EXPECT_NEAR(foot, 0, 0.03) << f;  // its first frame tells how it stands
    EXPECT_NEAR(thigh, 0, 0.2) << f;  // and the knee stays over the foot
  }
  EXPECT_NEAR(body.turned(most + 1, true)[0], 0.02, 0.02);
  for (int f = most + 2; f < most + 30; ++f) body.turned(f, true);
  EXPECT_NEAR(body.turned(most + 30, true)[0], 30 * kFrame, 0.05);
}

TEST(FootLock, SetsAFootAheadByHalfOfWhatTheBodyTurnsOverIt) {
  Turning body;
  Footwork work;
  work.turn = body.rate;
  for (int f = 0; f < 30; ++f) body.turned(f, true, work);
  double before = body.turned(30, false, work)[0], fastest = 0;
  for (int f = 31; f < 90; ++f) {
    const double now = body.turned(f, false, work)[0];
    fastest = std::max(fastest, std::abs(now - before) / kFrame);
    before = now;
  }
  EXPECT_NEAR(before, 89 * kFrame + 0.25, 0.02);
  EXPECT_LT(fastest, 5);  // a step turns it by 0.75 rad, smoothly
}

TEST(FootLock, StepsOutOfATurnThatItStandsIn) {
  Turning body;
  for (int f = 0; f < 30; ++f) body.turned(f, true, {}, true);
  double turned = 0;
  for (int f = 30; f < 90; ++f) {
    body.rate = 30.0 / f;  // it turns no more
    turned = body.turned(f, true, {}, true)[0];
  }
  EXPECT_NEAR(turned, 30 * kFrame, 0.07);  // that of the release is left when it is planted again
}

TEST(FootLock, KeepsTheEndOfALegWithoutAFootWhereItIs) {
  Carried body{on_shins()};
  const Vector3 place = body.shown(0, true);
  for (int f = 1; f < 30; ++f) EXPECT_LT((body.shown(f, true) - place).head<2>().norm(), 5e-3) << f;
  EXPECT_TRUE(body.lock.locked(0));
}

// How far a ball goes along the ground in a frame in which its motion goes at a speed and lifts it, or sets it down, at
// another, while its contact goes on, or begins or ends.
double gone(double rises, FootLock::Frames frames) {
  Carried body;
  Contacts contacts;
  contacts.feet = {std::vector<bool>{false, true, true, true, false}, std::vector<bool>(5, false)};
  contacts.floors = find_contacts(body.kinematics, body.clip).floors;
  Vector2 before = Vector2::Zero(), now = Vector2::Zero();
  for (int f = 0; f < 30; ++f) {
    WorldPose pose{load_vector(body.clip.root_positions.data()), body.clip.headings[0], {}};
    pose.root += Vector3{0, body.speed, rises} * (f - 29) * kFrame;
    pose.rotations.assign(body.clip.rotations.begin(),
                          body.clip.rotations.begin() + std::ptrdiff_t{4} * body.skeleton.size());
    body.lock.apply(pose, contacts, f < 29 ? FootLock::Frames{2, 2, 2} : frames, f == 0 ? 0 : kFrame);
    PosedBones posed(body.skeleton.size());
    body.kinematics.world(pose.root, pose.rotations.data(), posed.heads.data(), posed.rotations.data());
    before = now;
    now = ball(body.skeleton, body.legs[0], posed).head<2>();
  }
  return (now - before).norm();
}

TEST(FootLock, LetsABallRollOffAndComeDownAsItsMotionDoesOnlyWhereAContactBeginsOrEnds) {
  const double motion = 0.3 * kFrame;
  const FootLock::Frames begins{1, 0, 3}, goes_on{2, 1, 3}, ends{3, 1, 4};
  EXPECT_GT(gone(kLeaves, ends), 0.9 * motion);
  EXPECT_NEAR(gone(kLeaves / 2, ends), motion / 2, 0.1 * motion);
  EXPECT_LT(gone(kLeaves, goes_on), 0.1 * motion);
  EXPECT_LT(gone(0, ends), 0.1 * motion);
  EXPECT_LT(gone(-0.01, begins), 0.1 * motion);
}

TEST(FootLock, EditsStepsByTheFeetsPlacesFromTheHipsAndAShift) {
  Carried body;
  WorldPose pose{load_vector(body.clip.root_positions.data()), 0.5, {}};
  pose.rotations.assign(body.clip.rotations.begin(),
                        body.clip.rotations.begin() + std::ptrdiff_t{4} * body.skeleton.size());
  const auto place = [&](const WorldPose& shown) {
    PosedBones posed(body.skeleton.size());
    body.kinematics.world(shown.root, shown.rotations.data(), posed.heads.data(), posed.rotations.data());
    return Vector2{(ball(body.skeleton, body.legs[0], posed) - shown.root).head<2>()};
  };
  const Vector2 before = place(pose);
  StepEdit edit;
  edit.stride << 0.5, 0, 0.2, -0.3;
  edit.shift = {0.04, 0.12};
  body.lock.apply(pose, standing(false), {}, 0, edit);
  const Matrix2 heading = Eigen::Rotation2Dd(0.5).toRotationMatrix();
  const Vector2 wanted = before + heading * (edit.stride * heading.transpose() * before + edit.shift);
  EXPECT_LT((place(pose) - wanted).norm(), 0.005);
  EXPECT_GT((wanted - before).norm(), 0.05);
}

TEST(FootLock, LetsGoSmoothlyAndStepsBackToTheMotion) {
  Carried body, free;
  Vector3 before = body.shown(0, true);
  free.shown(0, false);
  double highest = 0;
  for (int f = 1; f < 120; ++f) {
    const Vector3 now = body.shown(f, f < 30), moved = free.shown(f, false);
    highest = std::max(highest, now.z() - moved.z());
    EXPECT_LT((now - before).norm(), 0.05) << f;  // 3 m/s
    if (f > 30 + 0.3 / kFrame + 1) {
      EXPECT_LT((now - moved).head<2>().norm(), 0.03) << f;
    }
    if (f > 30 + 1.32 / kFrame + 1) {
      EXPECT_LT((now - moved).norm(), 1e-9) << f;
    }
    before = now;
  }
  EXPECT_GT(highest, 0.02);
}

TEST(FootLock, LetsAFootGoThatIsTooFarBehind) {
  Carried body;
  body.speed = 2;
  for (int f = 0; f < 30; ++f) body.shown(f, true);
  Carried free;
  free.speed = 2;
  free.shown(0, false);
  EXPECT_LT((body.shown(30, true) - free.shown(30, false)).head<2>().norm(), 0.4);
}

// For how many frames a body that goes on keeps its left foot.
int kept_frames(bool right) {
  Carried body;
  body.speed = 1.5;
  int frame = 0;
  do body.posed(frame++, standing(true, right));
  while (body.lock.locked(0) && frame < 60);
  return frame;
}

TEST(FootLock, KeepsTheOnlyFootThatStandsForLonger) {
  EXPECT_GT(kept_frames(false), kept_frames(true));
  EXPECT_LT(kept_frames(false), 0.5 / 1.5 / kFrame + 4);
}

TEST(FootLock, KeepsAFootUntilTheOtherOneIsDownWhoseTurnItIs) {
  Carried body;
  body.shown(0, true);
  Contacts swapped = standing(false, true);
  swapped.floors[1] = {-1, -1};  // the right foot is far over it
  for (int f = 1; f < 10; ++f) {
    body.posed(f, swapped);
    EXPECT_TRUE(body.lock.locked(0)) << f;
    EXPECT_FALSE(body.lock.locked(1)) << f;
  }
  for (int f = 10; f < 12; ++f) body.posed(f, standing(false, true));
  EXPECT_FALSE(body.lock.locked(0));
  EXPECT_TRUE(body.lock.locked(1));
}

// Gives the feet toes, which lie flat.
void add_toes(Carried& body) {
  Skeleton& s = body.skeleton;
  for (int* toe : {&s.roles.left_toe, &s.roles.right_toe}) {
    const bool left = toe == &s.roles.left_toe;
    const int foot = left ? s.roles.left_foot : s.roles.right_foot;
    *toe = s.size();
    add_bone(s, left ? "toe.L" : "toe.R", foot, s.tips[foot], {0, -0.06, 0});
    body.clip.rotations.insert(body.clip.rotations.begin() + std::ptrdiff_t{4} * (s.size() - 1), {1, 0, 0, 0});
  }
  body.clip.rotations.resize(std::size_t{4} * s.size());
  body.clip.frames = 1;
  body.kinematics = Kinematics(s);
  body.legs = find_legs(body.kinematics, {body.clip});
  body.lock = FootLock(body.kinematics, body.legs);
}

TEST(FootLock, RaisesTheHeelOfAFootThatIsLeftBehindRatherThanSink) {
  Carried body;
  body.on_floor = true;
  add_toes(body);
  const Leg& leg = body.legs[0];
  const PosedBones first = body.posed(0, standing(true));
  const Vector3 place = ball(body.skeleton, leg, first);
  const auto pitch = [&](const PosedBones& now) {
    return (now.heads[leg.foot] - ball(body.skeleton, leg, now)).normalized().z();
  };
  body.speed = 0.6;
  PosedBones last = first;
  for (int f = 1; f <= 27; ++f) last = body.posed(f, standing(true));
  ASSERT_TRUE(body.lock.locked(0));
  EXPECT_LT((ball(body.skeleton, leg, last) - place).norm(), 0.01);
  EXPECT_GT(pitch(last), pitch(first) + 0.07);
  EXPECT_LT(last.rotations[leg.toe].angularDistance(first.rotations[leg.toe]), 1e-6);
  EXPECT_GT(last.heads[body.skeleton.roles.hips].z(), first.heads[body.skeleton.roles.hips].z() - 0.03);
  for (int f = 28; f < 90; ++f) last = body.posed(f, standing(false));
  EXPECT_NEAR(pitch(last), pitch(first), 1e-3);
}

TEST(FootLock, StepsOnWithAFootThatTheLegCannotReachRatherThanLungeOrDragIt) {
  Carried body, free;
  body.speed = free.speed = 1.2;
  body.on_floor = free.on_floor = true;
  const Vector3 place = body.shown(0, true);
  free.shown(0, false);
  int held = 0, dragged = 0;
  double highest = 0;
  Vector3 before = place;
  for (int f = 1; f < 30; ++f) {
    const Vector3 now = body.shown(f, true);
    const double over = now.z() - free.shown(f, false).z(), speed = (now - before).head<2>().norm() / kFrame;
    held += (now - place).head<2>().norm() < 0.01 ? 1 : 0;
    dragged += speed > 0.5 && over < 0.01 ? 1 : 0;
    highest = std::max(highest, over);
    before = now;
  }
  EXPECT_GT(held, 6);     // a tenth of a second
  EXPECT_LT(dragged, 8);  // it leaves the ground, and lands
  EXPECT_GT(highest, 0.03);
}

// How high over the floor a foot ends that plays a little over it, planted or not.
double ends_at(double height, bool planted) {
  Carried body;
  body.speed = 0;
  body.on_floor = true;
  const double floor = find_contacts(body.kinematics, body.clip).floors[0].ball;
  body.clip.root_positions[2] += height;
  Vector3 shown;
  for (int f = 0; f < 60; ++f) shown = body.shown(f, planted);
  return shown.z() - floor;
}

TEST(FootLock, LowersAPlantedFootThatHoversAndLeavesOneThatSwings) {
  for (const double height : {0.03, 0.05}) {
    EXPECT_LT(ends_at(height, true), 0.026) << height;
    EXPECT_GT(ends_at(height, true), 0.005) << height;
    EXPECT_GT(ends_at(height, false), height - 0.01) << height;
  }
}

// How far a foot that is carried over the ground at 2 m/s is lifted, m of a 1.8 m character.
double lifted(bool on_ground, double clears) {
  Carried body;
  body.speed = 2;
  body.on_floor = true;
  double height = 0;
  for (int f = 0; f < 30; ++f) {
    WorldPose pose{load_vector(body.clip.root_positions.data()), body.clip.headings[0], {}};
    pose.root.y() += body.speed * f * kFrame;
    pose.root.z() += on_ground ? 0 : 0.2;
    pose.rotations.assign(body.clip.rotations.begin(),
                          body.clip.rotations.begin() + std::ptrdiff_t{4} * body.skeleton.size());
    const auto place = [&] {
      PosedBones posed(body.skeleton.size());
      body.kinematics.world(pose.root, pose.rotations.data(), posed.heads.data(), posed.rotations.data());
      return ball(body.skeleton, body.legs[0], posed).z();
    };
    Contacts contacts = standing(false);
    contacts.floors = find_contacts(body.kinematics, body.clip).floors;
    const double before = place();
    Footwork work;
    work.clears = clears;
    body.lock.apply(pose, contacts, {}, f == 0 ? 0 : kFrame, {}, work);
    height = (place() - before) * standard_scale(body.skeleton);
  }
  return height;
}

TEST(FootLock, LiftsAFreeFootOffTheFloorThatWouldBeDragged) {
  EXPECT_NEAR(lifted(true, 1), 0.025, 0.003);
  EXPECT_NEAR(lifted(true, 0.5), 0.0125, 0.003);
  EXPECT_NEAR(lifted(true, 0), 0, 1e-3);
  EXPECT_NEAR(lifted(false, 1), 0, 1e-3);
}

TEST(FootLock, StepsOutOfAStrideThatItStandsIn) {
  Carried body;
  Contacts both;
  both.feet = {std::vector<bool>(1, true), std::vector<bool>(1, true)};
  both.floors.fill({1, 1});
  double highest = 0;
  Vector3 before = Vector3::Zero();
  for (int f = 0; f < 120; ++f) {
    WorldPose pose{load_vector(body.clip.root_positions.data()), body.clip.headings[0], {}};
    pose.root.y() += f < 6 ? 0.03 * f : 0.15;  // it goes on for a bit and stands
    pose.rotations.assign(body.clip.rotations.begin(),
                          body.clip.rotations.begin() + std::ptrdiff_t{4} * body.skeleton.size());
    PosedBones moved(body.skeleton.size()), posed(body.skeleton.size());
    body.kinematics.world(pose.root, pose.rotations.data(), moved.heads.data(), moved.rotations.data());
    body.lock.apply(pose, both, {}, f == 0 ? 0 : kFrame);
    body.kinematics.world(pose.root, pose.rotations.data(), posed.heads.data(), posed.rotations.data());
    const Vector3 now = ball(body.skeleton, body.legs[0], posed), free = ball(body.skeleton, body.legs[0], moved);
    highest = std::max(highest, now.z() - free.z());
    if (f > 0) {
      EXPECT_LT((now - before).norm(), 0.03) << f;
    }
    if (f == 15) {
      EXPECT_GT((now - free).head<2>().norm(), 0.1);
    }
    if (f == 119) {
      EXPECT_LT((now - free).head<2>().norm(), 0.02);
    }
    before = now;
  }
  EXPECT_GT(highest, 0.02);
}

TEST(FootLock, LeavesASkeletonWithoutLegsAsItIs) {
  Skeleton skeleton = humanoid();
  skeleton.roles.left_thigh = skeleton.roles.right_thigh = -1;
  FootLock lock{Kinematics(skeleton), {}};
  const Clip clip = gait_clip({1.2, 0, 0});
  WorldPose pose{load_vector(clip.root_positions.data()), 0, {}};
  pose.rotations.assign(clip.rotations.begin(), clip.rotations.begin() + std::ptrdiff_t{4} * skeleton.size());
  const std::vector<double> before = pose.rotations;
  lock.apply(pose, standing(true), {}, kFrame);
  EXPECT_EQ(pose.rotations, before);
}

TEST(TooHigh, IsAllOfTheHipsHeightWhereAnAnkleIsOutOfReachSideways) {
  EXPECT_DOUBLE_EQ(too_high(1, {0, 0, 0.9}, {0.6, 0, 0}), 0.9 - 0.8);
  EXPECT_DOUBLE_EQ(too_high(1, {0, 0, 0.3}, {0, 0.6, 0}), 0.3 - 0.8);
  EXPECT_DOUBLE_EQ(too_high(1, {0, 0, 0.3}, {1.2, 0, 0}), 0.3);
}

}  // namespace
}  // namespace fragmotion

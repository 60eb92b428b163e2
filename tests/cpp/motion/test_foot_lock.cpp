// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "fragmotion/motion/foot_lock.hpp"
#include "fragmotion/motion/legs.hpp"
#include "walker.hpp"

namespace fragmotion {
namespace {

constexpr double kFrame = 1.0 / 60;

// A frame with the left foot on the ground or not, at whatever height.
Contacts standing(bool left) {
  Contacts contacts;
  contacts.feet = {std::vector<bool>{left}, std::vector<bool>{false}};
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

  Vector3 shown(int frame, bool planted) {
    WorldPose pose{load_vector(clip.root_positions.data()), clip.headings[0], {}};
    pose.root.y() += speed * frame * kFrame;
    pose.rotations.assign(clip.rotations.begin(), clip.rotations.begin() + std::ptrdiff_t{4} * skeleton.size());
    Contacts contacts = standing(planted);
    if (on_floor) contacts.floors = find_contacts(kinematics, clip).floors;
    lock.apply(pose, contacts, 0, frame == 0 ? 0 : kFrame);
    PosedBones posed(skeleton.size());
    kinematics.world(pose.root, pose.rotations.data(), posed.heads.data(), posed.rotations.data());
    return ball(skeleton, legs[0], posed);
  }
};

TEST(FootLock, KeepsAPlantedFootWhereItIs) {
  Carried body;
  const Vector3 place = body.shown(0, true);
  for (int f = 1; f < 30; ++f) EXPECT_LT((body.shown(f, true) - place).head<2>().norm(), 5e-3) << f;
  EXPECT_TRUE(body.lock.locked(0));
  EXPECT_FALSE(body.lock.locked(1));
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
  body.lock.apply(pose, standing(false), 0, 0, edit);
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
    if (f > 30 + 1.2 / kFrame + 1) {
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
    body.lock.apply(pose, both, 0, f == 0 ? 0 : kFrame);
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
  lock.apply(pose, standing(true), 0, kFrame);
  EXPECT_EQ(pose.rotations, before);
}

}  // namespace
}  // namespace fragmotion

// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "base/random.hpp"
#include "runtime/inertialization.hpp"

namespace fragmotion {
namespace {

constexpr double kApart = 1e-4, kSeconds = 0.3;
constexpr int kBones = kBoneBlock + 3;

Quaternion random_rotation(Random& random, double angle) {
  const Vector3 axis{random.uniform() - 0.5, random.uniform() - 0.5, random.uniform() - 0.5};
  return Quaternion{Eigen::AngleAxisd(angle * random.uniform(), axis.normalized())};
}

// A motion of bones that goes and turns evenly.
struct Motion {
  Vector3 root, speed;
  Quaternion start[kBones];
  Vector3 turn[kBones];

  explicit Motion(Random& random) {
    const auto draw = [&](Vector3& v) { v = {random.uniform() - 0.5, random.uniform() - 0.5, random.uniform() - 0.5}; };
    draw(root);
    draw(speed);
    for (Vector3& v : turn) draw(v);
    for (Quaternion& q : start) q = random_rotation(random, 2);
  }

  WorldPose at(double time) const {
    WorldPose pose{root + time * speed, time * speed.x(), {}};
    pose.rotations.resize(std::size_t{4} * kBones);
    for (int b = 0; b < kBones; ++b) {
      const Quaternion by{Eigen::AngleAxisd(time * turn[b].norm(), turn[b].normalized())};
      store_quaternion(by * start[b], &pose.rotations[4 * b]);
    }
    return pose;
  }
};

double largest_difference(const WorldPose& a, const WorldPose& b) {
  double largest = std::max((a.root - b.root).norm(), std::abs(a.heading - b.heading));
  for (int i = 0; i < 4 * kBones; i += 4) {
    largest = std::max(largest, load_quaternion(&a.rotations[i]).angularDistance(load_quaternion(&b.rotations[i])));
  }
  return largest;
}

TEST(Inertialization, BeginsWithTheOldMotionAndItsSpeedAndEndsWithTheNewOne) {
  Random random(1);
  for (int n = 0; n < 100; ++n) {
    const Motion old(random), fresh(random);
    Inertialization inertia(kBones);
    inertia.begin(old.at(0), old.at(kApart), fresh.at(0), fresh.at(kApart), kApart, kSeconds);
    const auto shown = [&](double time) {
      WorldPose pose = fresh.at(time);
      inertia.apply(time, pose);
      return pose;
    };
    EXPECT_LT(largest_difference(shown(0), old.at(0)), 1e-6);
    WorldPose later = old.at(kApart);  // but for how fast the root goes over the ground
    later.root.head<2>() = shown(kApart).root.head<2>();
    EXPECT_LT(largest_difference(shown(kApart), later), 1e-6);
    EXPECT_LT(largest_difference(shown(4 * kSeconds - kApart), fresh.at(4 * kSeconds - kApart)), 0.01);
    EXPECT_FALSE(inertia.active(4 * kSeconds));
    EXPECT_EQ(largest_difference(shown(4 * kSeconds), fresh.at(4 * kSeconds)), 0);
  }
}

TEST(Inertialization, TakesRoundingForNoOffset) {
  Random random(3);
  const WorldPose pose = Motion(random).at(0);
  WorldPose rounded = pose;
  for (double& value : rounded.rotations) value += 1e-16;
  Inertialization inertia(kBones);
  inertia.begin(rounded, rounded, pose, pose, 1.0 / 60, kSeconds);
  WorldPose shown = pose;
  for (double& value : shown.rotations) value = static_cast<float>(value);
  const std::vector<double> before = shown.rotations;
  inertia.apply(kSeconds, shown);
  EXPECT_EQ(shown.rotations, before);
}

TEST(Inertialization, LeavesThreeTenthsOfAnOffsetAfterItsTime) {
  WorldPose old{{1, 2, 3}, 0.5, {1, 0, 0, 0}}, fresh{{0, 0, 0}, 0, {1, 0, 0, 0}};
  Inertialization inertia(1);
  inertia.begin(old, old, fresh, fresh, kApart, kSeconds);
  inertia.apply(kSeconds, fresh);
  EXPECT_NEAR(fresh.root.z(), 0.9, 0.03);
  EXPECT_NEAR(fresh.heading, 0.15, 0.005);
}

// A bone that turns about x at a speed, from an angle on.
WorldPose turned(double angle) {
  WorldPose pose{Vector3::Zero(), 0, std::vector<double>(std::size_t{4} * kBones)};
  for (int i = 0; i < 4 * kBones; i += 4) {
    store_quaternion(Quaternion{Eigen::AngleAxisd(angle, Vector3::UnitX())}, &pose.rotations[i]);
  }
  return pose;
}

TEST(Inertialization, GoesOneWayRoundFromWhatIsTurnedByHalf) {
  constexpr double kSpeed = 3;  // rad/s
  Inertialization inertia(kBones);
  inertia.begin(turned(kPi - 1e-6), turned(kPi - 1e-6 + kSpeed * kApart), turned(0), turned(0), kApart, kSeconds);
  WorldPose before = turned(kPi - 1e-6);
  for (int f = 1; f < 60; ++f) {
    WorldPose pose = turned(0);
    inertia.apply(f / 60.0, pose);
    EXPECT_LT(largest_difference(before, pose), 0.3) << f;
    before = pose;
  }
}

TEST(Inertialization, CarriesAPoseNoFurtherInALongStitch) {
  constexpr double kSpeed = 15;  // rad/s
  for (const double seconds : {0.1, 0.2, 0.5, 1.0}) {
    Inertialization inertia(kBones);
    inertia.begin(turned(0), turned(kSpeed * kApart), turned(0), turned(0), kApart, seconds);
    for (int f = 0; f < 60; ++f) {
      WorldPose pose = turned(0);
      inertia.apply(f / 60.0, pose);
      EXPECT_LT(largest_difference(turned(0), pose), 0.55) << seconds;
    }
  }
}

TEST(Inertialization, NeverSteps) {
  Random random(2);
  const Motion old(random), fresh(random);
  Inertialization inertia(kBones);
  inertia.begin(old.at(0), old.at(kApart), fresh.at(0), fresh.at(kApart), kApart, kSeconds);
  WorldPose before = old.at(0);
  for (double time = 0; time < 2 * kSeconds; time += 1e-3) {
    WorldPose now = fresh.at(time);
    inertia.apply(time, now);
    EXPECT_LT(largest_difference(now, before), 0.025) << time;
    before = now;
  }
}

}  // namespace
}  // namespace fragmotion

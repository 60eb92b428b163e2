// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "io/rotation.hpp"
#include "small_skeleton.hpp"

namespace fragmotion {
namespace {

const char* const kOrders[] = {"XYZ", "XZY", "YXZ", "YZX", "ZXY", "ZYX"};

Eigen::Matrix3d about(int axis, double angle) {
  return Eigen::AngleAxisd(angle, Vector3::Unit(axis)).toRotationMatrix();
}

std::vector<double> smooth_rotations(int frames, std::uint64_t seed) {
  Random random(seed);
  const Vector3 start = random_vector(random, 3), speed = random_vector(random, 0.3);
  std::vector<double> angles;
  for (int f = 0; f < frames; ++f) {
    const Vector3 now = start + f * speed;
    angles.insert(angles.end(), now.data(), now.data() + 3);
  }
  return angles;
}

TEST(EulerToQuaternion, AppliesTheFirstAxisFirstAboutFixedAxes) {
  const double angles[] = {0.3, -0.8, 1.9};
  for (const std::string order : kOrders) {
    const int i = order[0] - 'X', j = order[1] - 'X', k = order[2] - 'X';
    const Eigen::Matrix3d expected = about(k, angles[k]) * about(j, angles[j]) * about(i, angles[i]);
    const Quaternion q = load_quaternion(euler_to_quaternion(order, angles, 1).data());
    EXPECT_LT((q.toRotationMatrix() - expected).norm(), 1e-14) << order;
  }
}

TEST(EulerToQuaternion, AgreesWithBlender) {
  // mathutils.Euler((0.3, -0.8, 1.9), order).to_quaternion()
  const double angles[] = {0.3, -0.8, 1.9};
  const struct {
    const char* order;
    Quaternion q;
  } cases[] = {
      {"XYZ", {0.4824137, 0.3932659, -0.1120147, 0.7746429}},  {"XZY", {0.5770854, -0.2331382, -0.1120147, 0.7746429}},
      {"YXZ", {0.5770854, 0.3932659, -0.1120147, 0.7069421}},  {"YZX", {0.4824137, 0.3932659, -0.3359344, 0.7069421}},
      {"ZXY", {0.4824137, -0.2331382, -0.3359344, 0.7746429}}, {"ZYX", {0.5770854, -0.2331382, -0.3359344, 0.7069421}},
  };
  for (const auto& c : cases) {
    const Quaternion q = load_quaternion(euler_to_quaternion(c.order, angles, 1).data());
    EXPECT_LT(q.angularDistance(c.q), 1e-6) << c.order;
  }
}

TEST(QuaternionToEuler, InvertsEulerToQuaternion) {
  Random random(2);
  for (const std::string order : kOrders) {
    for (int n = 0; n < 200; ++n) {
      double stored[4];
      const Quaternion q = random_rotation(random);
      store_quaternion(q, stored);
      const std::vector<double> angles = quaternion_to_euler(order, stored, 1);
      const std::vector<double> back = euler_to_quaternion(order, angles.data(), 1);
      EXPECT_LT(load_quaternion(back.data()).angularDistance(q), 1e-12) << order;
    }
  }
}

TEST(QuaternionToEuler, InvertsInGimbalLock) {
  for (const std::string order : kOrders) {
    for (const double middle : {kPi / 2, -kPi / 2, kPi / 2 - 1e-9, kPi / 2 + 1e-6}) {
      double angles[] = {0.4, 0.4, -0.7};
      angles[order[1] - 'X'] = middle;
      const std::vector<double> rotation = euler_to_quaternion(order, angles, 1);
      const std::vector<double> found = quaternion_to_euler(order, rotation.data(), 1);
      const std::vector<double> back = euler_to_quaternion(order, found.data(), 1);
      EXPECT_LT(load_quaternion(back.data()).angularDistance(load_quaternion(rotation.data())), 1e-7) << order;
    }
  }
}

TEST(QuaternionToEuler, LeavesTheThirdAngleAloneInGimbalLock) {
  for (const std::string order : kOrders) {
    std::vector<double> angles(6);
    for (int f = 0; f < 2; ++f) {
      angles[3 * f + order[0] - 'X'] = 0.4;
      angles[3 * f + order[1] - 'X'] = f == 0 ? 1.5 : kPi / 2;
      angles[3 * f + order[2] - 'X'] = 1.1;
    }
    const std::vector<double> rotations = euler_to_quaternion(order, angles.data(), 2);
    const std::vector<double> found = quaternion_to_euler(order, rotations.data(), 2);
    for (int i = 0; i < 6; ++i) EXPECT_NEAR(found[i], angles[i], 1e-7) << order;
  }
}

TEST(QuaternionToEuler, StaysContinuous) {
  for (const std::string order : kOrders) {
    for (int seed = 0; seed < 20; ++seed) {
      constexpr int kFrames = 100;  // several turns
      const std::vector<double> angles = smooth_rotations(kFrames, seed);
      const std::vector<double> rotations = euler_to_quaternion(order, angles.data(), kFrames);
      const std::vector<double> found = quaternion_to_euler(order, rotations.data(), kFrames);
      for (int i = 3; i < 3 * kFrames; ++i) EXPECT_LE(std::abs(found[i] - found[i - 3]), kPi) << order;
    }
  }
}

TEST(QuaternionToEuler, FollowsATurnBeyondHalfACircle) {
  std::vector<double> angles;
  for (int f = 0; f < 100; ++f) angles.insert(angles.end(), {0.1, -0.2, 0.1 * f});
  const std::vector<double> rotations = euler_to_quaternion("XYZ", angles.data(), 100);
  const std::vector<double> found = quaternion_to_euler("XYZ", rotations.data(), 100);
  for (int i = 0; i < 300; ++i) EXPECT_NEAR(found[i], angles[i], 1e-12);
}

TEST(AxisAngle, RoundTrips) {
  Random random(3);
  for (int n = 0; n < 200; ++n) {
    double stored[4];
    const Quaternion q = random_rotation(random);
    store_quaternion(q, stored);
    const std::vector<double> axis_angle = quaternion_to_axis_angle(stored, 1);
    EXPECT_NEAR(load_vector(&axis_angle[1]).norm(), 1, 1e-14);
    const std::vector<double> back = axis_angle_to_quaternion(axis_angle.data(), 1);
    EXPECT_LT((load_quaternion(back.data()).coeffs() - q.coeffs()).norm(), 1e-14);
  }
}

TEST(AxisAngle, HandlesSpecialCases) {
  const double zero_axis[] = {1, 0, 0, 0}, long_axis[] = {kPi / 2, 0, 0, 3}, identity[] = {1, 0, 0, 0};
  EXPECT_EQ(axis_angle_to_quaternion(zero_axis, 1), (std::vector<double>{1, 0, 0, 0}));
  EXPECT_NEAR(axis_angle_to_quaternion(long_axis, 1)[3], std::sqrt(0.5), 1e-15);
  EXPECT_EQ(quaternion_to_axis_angle(identity, 1), (std::vector<double>{0, 0, 1, 0}));
  const double tiny[] = {1, 0, 1e-200, 0};
  EXPECT_NEAR(quaternion_to_axis_angle(tiny, 1)[2], 1, 1e-15);
}

TEST(Rotation, RefusesBadInputNamingTheFrame) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double bad[] = {1, 0, 0, 0, 0, nan, 0, 1}, zero[] = {1, 0, 0, 0, 0, 0, 0, 0};
  const auto message = [](const auto& call) -> std::string {
    try {
      call();
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_EQ(message([&] { euler_to_quaternion("XYZ", bad, 2); }), "frame 1: the rotation is not finite");
  EXPECT_EQ(message([&] { quaternion_to_euler("XYZ", bad, 2); }), "frame 1: the rotation is not finite");
  EXPECT_EQ(message([&] { quaternion_to_euler("XYZ", zero, 2); }), "frame 1: the rotation is a zero quaternion");
  EXPECT_EQ(message([&] { axis_angle_to_quaternion(bad, 2); }), "frame 1: the rotation is not finite");
  EXPECT_EQ(message([&] { quaternion_to_axis_angle(zero, 2); }), "frame 1: the rotation is a zero quaternion");
  for (const char* order : {"", "XY", "XYZX", "XYX", "xyz", "QUATERNION"}) {
    EXPECT_NE(message([&] { euler_to_quaternion(order, zero, 0); }).find("expected one of XYZ"), std::string::npos);
    EXPECT_NE(message([&] { quaternion_to_euler(order, zero, 0); }).find("expected one of XYZ"), std::string::npos);
  }
}

}  // namespace
}  // namespace fragmotion

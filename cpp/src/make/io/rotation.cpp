// SPDX-License-Identifier: MIT
#include "io/rotation.hpp"

#include <cmath>
#include <cstddef>
#include <stdexcept>

#include "base/rounding.hpp"

namespace fragmotion {

namespace {

struct Order {
  int first, second, third;  // axes
  double sign;               // +1 where the axes are a cyclic permutation of X, Y, Z
};

Order parse_order(const std::string& order) {
  for (const char* known : {"XYZ", "XZY", "YXZ", "YZX", "ZXY", "ZYX"}) {
    if (order != known) continue;
    const int first = order[0] - 'X', second = order[1] - 'X', third = order[2] - 'X';
    return {first, second, third, (first + 1) % 3 == second ? 1.0 : -1.0};
  }
  throw std::invalid_argument("rotation order '" + order + "': expected one of XYZ, XZY, YXZ, YZX, ZXY, ZYX");
}

[[noreturn]] void fail(int frame, const std::string& cause) {
  throw std::invalid_argument("frame " + std::to_string(frame) + ": " + cause);
}

void check_finite(const double* values, int count, int frame) {
  for (int i = 0; i < count; ++i) {
    if (!std::isfinite(values[i])) fail(frame, "the rotation is not finite");
  }
}

Quaternion unit_quaternion(const double* wxyz, int frame) {
  check_finite(wxyz, 4, frame);
  const Quaternion q = load_quaternion(wxyz);
  const double size = q.coeffs().cwiseAbs().maxCoeff();
  if (size == 0) fail(frame, "the rotation is a zero quaternion");
  return Quaternion{q.coeffs() / size}.normalized();
}

Quaternion about(int axis, double angle) { return Quaternion{Eigen::AngleAxisd(angle, Vector3::Unit(axis))}; }

/// The angles of `rotation` whose third angle is `third`, which must be a solution.
Vector3 solve(const Order& order, const Quaternion& rotation, double third) {
  const auto [i, j, k, sign] = order;
  const Eigen::Matrix3d m = (about(k, -third) * rotation).toRotationMatrix();  // R_j R_i
  Vector3 angles;
  angles[i] = std::atan2(-sign * m(j, k), m(j, j));
  angles[j] = std::atan2(-sign * m(k, i), m(i, i));
  angles[k] = third;
  return angles;
}

Vector3 unwrap(const Vector3& angles, const Vector3& previous) {
  const Vector3 turns = ((angles - previous) / (2 * kPi)).array().round();
  return angles - 2 * kPi * turns;
}

Vector3 nearest_angles(const Order& order, const Quaternion& rotation, const Vector3& previous) {
  const Eigen::Matrix3d m = rotation.toRotationMatrix();
  const double along = m(order.first, order.first), across = order.sign * m(order.second, order.first);
  // In gimbal lock any third angle is a solution; the one of the frame before moves least.
  if (std::hypot(along, across) < kRounding) return unwrap(solve(order, rotation, previous[order.third]), previous);
  const double third = std::atan2(across, along);
  const Vector3 one = unwrap(solve(order, rotation, third), previous);
  const Vector3 other = unwrap(solve(order, rotation, third + kPi), previous);
  return (one - previous).lpNorm<1>() <= (other - previous).lpNorm<1>() ? one : other;
}

}  // namespace

std::vector<double> euler_to_quaternion(const std::string& order, const double* angles, int frames) {
  const Order axes = parse_order(order);
  std::vector<double> rotations(4 * static_cast<std::size_t>(frames));
  for (int f = 0; f < frames; ++f) {
    const double* xyz = angles + 3 * static_cast<std::size_t>(f);
    check_finite(xyz, 3, f);
    const Quaternion q =
        about(axes.third, xyz[axes.third]) * about(axes.second, xyz[axes.second]) * about(axes.first, xyz[axes.first]);
    store_quaternion(q, &rotations[4 * static_cast<std::size_t>(f)]);
  }
  return rotations;
}

std::vector<double> quaternion_to_euler(const std::string& order, const double* rotations, int frames) {
  const Order axes = parse_order(order);
  std::vector<double> angles(3 * static_cast<std::size_t>(frames));
  Vector3 previous = Vector3::Zero();
  for (int f = 0; f < frames; ++f) {
    previous = nearest_angles(axes, unit_quaternion(rotations + 4 * static_cast<std::size_t>(f), f), previous);
    store_vector(previous, &angles[3 * static_cast<std::size_t>(f)]);
  }
  return angles;
}

std::vector<double> axis_angle_to_quaternion(const double* axis_angles, int frames) {
  std::vector<double> rotations(4 * static_cast<std::size_t>(frames));
  for (int f = 0; f < frames; ++f) {
    const double* from = axis_angles + 4 * static_cast<std::size_t>(f);
    check_finite(from, 4, f);
    // stableNormalized leaves a zero axis zero, and with it no rotation.
    const Vector3 axis = load_vector(from + 1).stableNormalized();
    const Quaternion q = axis.isZero(0) ? Quaternion::Identity() : Quaternion{Eigen::AngleAxisd(from[0], axis)};
    store_quaternion(q, &rotations[4 * static_cast<std::size_t>(f)]);
  }
  return rotations;
}

std::vector<double> quaternion_to_axis_angle(const double* rotations, int frames) {
  std::vector<double> axis_angles(4 * static_cast<std::size_t>(frames));
  for (int f = 0; f < frames; ++f) {
    const Quaternion q = unit_quaternion(rotations + 4 * static_cast<std::size_t>(f), f);
    const double sine = q.vec().stableNorm();
    double* to = &axis_angles[4 * static_cast<std::size_t>(f)];
    to[0] = 2 * std::atan2(sine, q.w());
    store_vector(sine > 0 ? q.vec().stableNormalized().eval() : Vector3::UnitY().eval(), to + 1);
  }
  return axis_angles;
}

}  // namespace fragmotion

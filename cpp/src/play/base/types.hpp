// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>

#ifdef FRAGMOTION_SAME_MATH
extern "C" void sine_and_cosine(double angle, double* sine, double* cosine);
#endif

namespace fragmotion {

/// Half a turn, rad.
constexpr double kPi = 3.14159265358979323846;

/// An angle within half a turn to either side, rad: std::remainder() by a turn, and most often at no cost.
inline double wrapped(double angle) { return std::abs(angle) <= kPi ? angle : std::remainder(angle, 2 * kPi); }

/// What pulls everything down, m/s^2.
constexpr double kGravity = 9.81;

/// An inch, m.
constexpr double kInch = 0.0254;

using Vector2 = Eigen::Vector2d;
using Vector3 = Eigen::Vector3d;
using Matrix2 = Eigen::Matrix2d;
using Quaternion = Eigen::Quaterniond;

/// Arrays hold rotations as (w, x, y, z); Eigen stores (x, y, z, w).
inline Quaternion load_quaternion(const double* wxyz) { return {wxyz[0], wxyz[1], wxyz[2], wxyz[3]}; }

inline void store_quaternion(const Quaternion& q, double* wxyz) {
  wxyz[0] = q.w();
  wxyz[1] = q.x();
  wxyz[2] = q.y();
  wxyz[3] = q.z();
}

inline Vector3 load_vector(const double* xyz) { return {xyz[0], xyz[1], xyz[2]}; }

inline void store_vector(const Vector3& v, double* xyz) { Eigen::Map<Vector3>{xyz} = v; }

/// The sum of the products of what two vectors hold, in one order: that of Eigen's own differs between its versions.
template <typename A, typename B>
typename A::Scalar dot(const Eigen::MatrixBase<A>& a, const Eigen::MatrixBase<B>& b) {
  return a.cwiseProduct(b).sum();
}

/// A rotation after another: Eigen's own, likewise.
inline Quaternion product(const Quaternion& a, const Quaternion& b) {
  const double w = a.w(), x = a.x(), y = a.y(), z = a.z(), p = b.w(), q = b.x(), r = b.y(), s = b.z();
  return {w * p - x * q - y * r - z * s, w * q + x * p + y * s - z * r, w * r + y * p + z * q - x * s,
          w * s + z * p + x * r - y * q};
}

/// A rotation of unit length but for roundings, without them: the first step to 1 / its length does.
inline Quaternion rounded_off(const Quaternion& q) {
  const double scale = 1.5 - 0.5 * (q.w() * q.w() + q.x() * q.x() + q.y() * q.y() + q.z() * q.z());
  return {scale * q.w(), scale * q.x(), scale * q.y(), scale * q.z()};
}

/// A vector turned by a rotation: Eigen's own, number by number, which compilers inline.
inline Vector3 turned(const Quaternion& by, const Vector3& v) {
  const double w = by.w(), x = by.x(), y = by.y(), z = by.z();
  const double a = 2 * (y * v.z() - z * v.y()), b = 2 * (z * v.x() - x * v.z()), c = 2 * (x * v.y() - y * v.x());
  return {v.x() + w * a + (y * c - z * b), v.y() + w * b + (z * a - x * c), v.z() + w * c + (x * b - y * a)};
}

/// A turn of the plane by an angle, rad: its cosine and sine, which together take little more time than one.
struct PlaneTurn {
  double cosine, sine;

  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-member-init): the function writes them
  explicit PlaneTurn(double angle) {
#ifdef FRAGMOTION_SAME_MATH
    sine_and_cosine(angle, &sine, &cosine);
#else
    cosine = std::cos(angle);
    sine = std::sin(angle);
#endif
  }

  PlaneTurn(double cosine, double sine) : cosine(cosine), sine(sine) {}

  PlaneTurn twice() const { return {cosine * cosine - sine * sine, 2 * sine * cosine}; }
  Vector2 operator*(const Vector2& v) const { return {cosine * v.x() - sine * v.y(), sine * v.x() + cosine * v.y()}; }
  Matrix2 matrix() const {
    Matrix2 matrix;
    matrix << cosine, -sine, sine, cosine;
    return matrix;
  }
};

/// The vector, or where it is longer than `most` the one of that length in its direction.
inline Vector2 clamp_length(const Vector2& v, double most) {
  const double length = v.norm();
  return length > most ? Vector2{v * (most / length)} : v;
}

}  // namespace fragmotion

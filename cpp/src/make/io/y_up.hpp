// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

#include "base/types.hpp"

namespace fragmotion {

/// The basis change from a y-up file to the z-up world: (x, y, z) -> (x, -z, y), a rotation of 90 degrees about x.
inline Vector3 z_up_from_y_up(const Vector3& v) { return {v.x(), -v.z(), v.y()}; }

/// The same for a rotation: its axis changes basis, its angle stays.
inline Quaternion z_up_from_y_up(const Quaternion& q) { return {q.w(), q.x(), -q.z(), q.y()}; }

/// The inverse: (x, y, z) -> (x, z, -y).
inline Vector3 y_up_from_z_up(const Vector3& v) { return {v.x(), v.z(), -v.y()}; }
inline Quaternion y_up_from_z_up(const Quaternion& q) { return {q.w(), q.x(), q.z(), -q.y()}; }

/// Rotation about the x, y or z axis (0, 1, 2).
inline Quaternion axis_rotation(int axis, double radians) {
  Quaternion q(std::cos(radians / 2), 0, 0, 0);
  q.vec()[axis] = std::sin(radians / 2);
  return q;
}

inline double radians_from_degrees(double degrees) { return degrees * (kPi / 180); }

}  // namespace fragmotion

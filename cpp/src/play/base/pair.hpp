// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

#include "base/types.hpp"

namespace fragmotion {

/// Two numbers side by side, of things that are computed together: each comes to the bit as it would alone.
using Pair = double __attribute__((vector_size(16)));

inline Pair root(const Pair& values) { return Pair{std::sqrt(values[0]), std::sqrt(values[1])}; }

/// Two vectors.
struct VectorPair {
  Pair x, y, z;

  VectorPair(const Pair& x, const Pair& y, const Pair& z) : x(x), y(y), z(z) {}
  VectorPair(const Vector3& a, const Vector3& b) : x{a.x(), b.x()}, y{a.y(), b.y()}, z{a.z(), b.z()} {}
  Vector3 operator[](int i) const { return {x[i], y[i], z[i]}; }

  friend VectorPair operator+(const VectorPair& a, const VectorPair& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend VectorPair operator-(const VectorPair& a, const VectorPair& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend VectorPair operator*(const Pair& by, const VectorPair& v) { return {by * v.x, by * v.y, by * v.z}; }
  friend VectorPair operator/(const VectorPair& v, const Pair& by) { return {v.x / by, v.y / by, v.z / by}; }
  friend Pair dot(const VectorPair& a, const VectorPair& b) { return a.x * b.x + (a.y * b.y + a.z * b.z); }
  friend VectorPair cross(const VectorPair& a, const VectorPair& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
  }
};

/// Two rotations; what is computed of them is as of single ones (types.hpp).
struct TurnPair {
  Pair w, x, y, z;

  TurnPair(const Pair& w, const Pair& x, const Pair& y, const Pair& z) : w(w), x(x), y(y), z(z) {}
  TurnPair(const Quaternion& a, const Quaternion& b)
      : w{a.w(), b.w()}, x{a.x(), b.x()}, y{a.y(), b.y()}, z{a.z(), b.z()} {}
  Quaternion operator[](int i) const { return {w[i], x[i], y[i], z[i]}; }
  void set(int i, const Quaternion& to) { w[i] = to.w(), x[i] = to.x(), y[i] = to.y(), z[i] = to.z(); }
  TurnPair conjugate() const { return {w, -x, -y, -z}; }
};

inline TurnPair product(const TurnPair& a, const TurnPair& b) {
  return {a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z, a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
          a.w * b.y + a.y * b.w + a.z * b.x - a.x * b.z, a.w * b.z + a.z * b.w + a.x * b.y - a.y * b.x};
}

inline TurnPair rounded_off(const TurnPair& q) {
  const Pair scale = 1.5 - 0.5 * (q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
  return {scale * q.w, scale * q.x, scale * q.y, scale * q.z};
}

inline VectorPair turned(const TurnPair& by, const VectorPair& v) {
  const VectorPair axis{by.x, by.y, by.z}, across = Pair{2, 2} * cross(axis, v), aside = cross(axis, across);
  return {v.x + by.w * across.x + aside.x, v.y + by.w * across.y + aside.y, v.z + by.w * across.z + aside.z};
}

}  // namespace fragmotion

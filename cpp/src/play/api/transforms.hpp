// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>

#include "fragmotion/fragmotion.h"

namespace fragmotion {

using Matrix16 = std::array<float, 16>;  ///< 4 x 4, column by column.

/// The product of rotations x, y, z, w.
inline void multiply(const float a[4], const float b[4], float out[4]) {
  const float product[4] = {
      a[3] * b[0] + a[0] * b[3] + a[1] * b[2] - a[2] * b[1], a[3] * b[1] - a[0] * b[2] + a[1] * b[3] + a[2] * b[0],
      a[3] * b[2] + a[0] * b[1] - a[1] * b[0] + a[2] * b[3], a[3] * b[3] - a[0] * b[0] - a[1] * b[1] - a[2] * b[2]};
  for (int i = 0; i < 4; ++i) out[i] = product[i];
}

/// A transform's matrix.
inline Matrix16 matrix_of(const FragmotionTransform& t) {
  const float x = t.rotation[0], y = t.rotation[1], z = t.rotation[2], w = t.rotation[3];
  return {1 - 2 * (y * y + z * z), 2 * (x * y + w * z),     2 * (x * z - w * y),     0,
          2 * (x * y - w * z),     1 - 2 * (x * x + z * z), 2 * (y * z + w * x),     0,
          2 * (x * z + w * y),     2 * (y * z - w * x),     1 - 2 * (x * x + y * y), 0,
          t.position[0],           t.position[1],           t.position[2],           1};
}

inline void multiply(const Matrix16& a, const Matrix16& b, float out[16]) {
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 4; ++row) {
      float sum = 0;
      for (int i = 0; i < 4; ++i) sum += a[4 * i + row] * b[4 * column + i];
      out[4 * column + row] = sum;
    }
  }
}

/// Where a transform puts a place.
inline void apply(const FragmotionTransform& t, const float place[3], float out[3]) {
  const Matrix16 m = matrix_of(t);
  for (int row = 0; row < 3; ++row) {
    out[row] = m[row] * place[0] + m[4 + row] * place[1] + m[8 + row] * place[2] + m[12 + row];
  }
}

/// First b, then a.
inline FragmotionTransform compose(const FragmotionTransform& a, const FragmotionTransform& b) {
  FragmotionTransform both;
  apply(a, b.position, both.position);
  multiply(a.rotation, b.rotation, both.rotation);
  return both;
}

inline FragmotionTransform inverse(const FragmotionTransform& t) {
  FragmotionTransform back{{0, 0, 0}, {-t.rotation[0], -t.rotation[1], -t.rotation[2], t.rotation[3]}};
  float place[3];
  apply(back, t.position, place);
  for (int i = 0; i < 3; ++i) back.position[i] = -place[i];
  return back;
}

}  // namespace fragmotion

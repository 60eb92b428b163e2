// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <locale>
#include <sstream>
#include <stdexcept>
#include <string>

#include "base/rounding.hpp"
#include "base/types.hpp"

namespace fragmotion {

// Relative difference of scales: lengths look the same that differ by less than 3 % (Teghtsoonian, "On the Exponents in
// Stevens' Law and the Constant in Ekman's Law", 1971).
constexpr double kUniform = 0.01;

using RowMajor = Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>;

[[noreturn]] inline void fail(const std::string& label, const std::string& cause) {
  throw std::invalid_argument(label + ": " + cause);
}

inline Vector3 column_lengths(const RowMajor& matrix) { return matrix.topLeftCorner<3, 3>().colwise().norm(); }

/// Whether a matrix is finite and scales to nothing, or to the other side of it: it has no rotation.
inline bool is_squashed(const RowMajor& matrix) {
  const Eigen::Matrix3d m = matrix.topLeftCorner<3, 3>();
  return matrix.allFinite() && (m.colwise().norm().minCoeff() < kRounding || m.determinant() <= 0);
}

/// The rotation in a matrix that may scale; keeps the direction of y, along the bone, where it also shears.
inline Quaternion extract_rotation(const RowMajor& matrix, const std::string& label) {
  const Eigen::Matrix3d m = matrix.topLeftCorner<3, 3>();
  if (!matrix.allFinite()) fail(label, "the matrix is not finite");
  if (m.colwise().norm().minCoeff() < kRounding) fail(label, "the matrix is flat (a scale of zero)");
  if (m.determinant() <= 0) fail(label, "the matrix is mirrored (a negative scale) or flat");
  const Vector3 y = m.col(1).normalized();
  const Vector3 x = m.col(0).normalized();
  const Vector3 square = (x - y * y.dot(x)).normalized();
  Eigen::Matrix3d rotation;
  rotation << square, y, square.cross(y);
  return Quaternion{rotation}.normalized();
}

inline bool is_square(const RowMajor& matrix, double tolerance) {
  const Eigen::Matrix3d m = matrix.topLeftCorner<3, 3>().colwise().normalized();
  return (m.transpose() * m - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() < tolerance;
}

inline std::string print_scale(const Vector3& scale) {
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text.precision(4);
  text << "(" << scale.x() << ", " << scale.y() << ", " << scale.z() << ")";
  return text.str();
}

/// How much more than along the ground an object's matrix stretches along the vertical, which shears nothing that turns
/// about it; 1 where it stretches nothing else than that, but for kUniform.
inline double stretch_upwards(const double* matrix) {
  const Eigen::Matrix3d m = RowMajor(matrix).topLeftCorner<3, 3>();
  const Vector3 lengths = m.rowwise().norm();
  const double wide = lengths.head<2>().mean(), stretch = lengths.z() / wide;
  const bool is_round = std::abs(lengths.x() - lengths.y()) <= kUniform * wide;
  return is_round && stretch > kRounding && std::isfinite(stretch) && std::abs(stretch - 1) > kUniform ? stretch : 1;
}

/// The scale of an object's matrix; it is called `printed` where it is refused.
inline double uniform_scale(const RowMajor& matrix, const Vector3& printed, const std::string& label) {
  const std::string advice =
      ": apply the scale (Ctrl+A); only one can be used that is uniform or differs upwards alone";
  if (!matrix.allFinite()) fail(label, "the world matrix is not finite");
  const Vector3 scale = column_lengths(matrix);
  const double mean = scale.mean();
  if (matrix.topLeftCorner<3, 3>().determinant() < 0)
    fail(label, "it is mirrored, by a negative scale of its own or of what it hangs on: make that positive");
  if (mean < kRounding || (scale.array() - mean).abs().maxCoeff() > kUniform * mean)
    fail(label, "the scale is " + print_scale(printed) + advice);
  if (!is_square(matrix, kUniform)) fail(label, "the object is sheared, with scale " + print_scale(printed) + advice);
  return mean;
}

}  // namespace fragmotion

// SPDX-License-Identifier: MIT
// The decompositions of Eigen that several stages call are compiled once: each is a few seconds of the compiler's time.
#include "base/decompositions.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <Eigen/SVD>

namespace fragmotion {

namespace {

using Svd = Eigen::JacobiSVD<Eigen::Matrix3d>;

Svd decomposed(const Eigen::Matrix3d& matrix) { return Svd(matrix, Eigen::ComputeFullU | Eigen::ComputeFullV); }

}  // namespace

Eigen::VectorXd least_squares(const Eigen::MatrixXd& columns, const Eigen::VectorXd& values) {
  return columns.colPivHouseholderQr().solve(values);
}

Eigen::Matrix3d nearest_orthogonal(const Eigen::Matrix3d& matrix) {
  const Svd svd = decomposed(matrix);
  return svd.matrixU() * svd.matrixV().transpose();
}

Quaternion nearest_rotation(const Eigen::Matrix3d& matrix) {
  const Svd svd = decomposed(matrix);
  const Vector3 signs(1, 1, (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0 ? -1 : 1);
  return Quaternion(Eigen::Matrix3d(svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose()));
}

Eigen::Matrix3d principal_axes(const Eigen::Matrix3d& symmetric) {
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(symmetric).eigenvectors().rowwise().reverse();
}

}  // namespace fragmotion

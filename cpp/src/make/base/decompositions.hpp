// SPDX-License-Identifier: MIT
#pragma once

#include "base/types.hpp"

namespace fragmotion {

/// By how much each column is to be taken so that together they come nearest to the values, by least squares.
Eigen::VectorXd least_squares(const Eigen::MatrixXd& columns, const Eigen::VectorXd& values);

/// The orthogonal matrix nearest to a matrix, which may mirror (Schönemann, "A generalized solution of the orthogonal
/// Procrustes problem", Psychometrika 1966).
Eigen::Matrix3d nearest_orthogonal(const Eigen::Matrix3d& matrix);

/// The rotation nearest to a matrix (Kabsch, "A solution for the best rotation to relate two sets of vectors", Acta
/// Crystallographica 1976).
Quaternion nearest_rotation(const Eigen::Matrix3d& matrix);

/// The axes along which a symmetric matrix stretches, as columns, the most stretched first.
Eigen::Matrix3d principal_axes(const Eigen::Matrix3d& symmetric);

}  // namespace fragmotion

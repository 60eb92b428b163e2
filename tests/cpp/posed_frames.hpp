// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "base/types.hpp"

namespace fragmotion {

using Frame = Eigen::Isometry3d;

/// A bone in the plane of a leg, turned about the axis across it.
inline Frame at(double y, double z, double angle = 0) {
  return Eigen::Translation3d(0, y, z) * Eigen::AngleAxisd(angle, Vector3::UnitX());
}

/// As rows of a pose.
inline void add_rows(const Frame& frame, std::vector<double>& values) {
  const Eigen::Matrix<double, 4, 4, Eigen::RowMajor> rows = frame.matrix();
  values.insert(values.end(), rows.data(), rows.data() + 16);
}

}  // namespace fragmotion

// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <string>
#include <vector>

#include "skeleton/skeleton.hpp"

namespace fragmotion {

constexpr char kAcclaimComment = '#';

/// A bone as the file tells it: y up, in file units, angles in radians. The first is the root.
struct AsfBone {
  std::string name;
  Vector3 direction = Vector3::Zero();
  double length = 0;
  Vector3 position = Vector3::Zero();  ///< Of the root.
  Vector3 axis_angles = Vector3::Zero();
  std::array<int, 3> axis_order = {0, 1, 2};
  std::vector<int> dofs;  ///< 0 to 2: translation along x, y, z; 3 to 5: rotation about them.
  int parent = -1;

  Vector3 tip() const { return length * direction; }

  /// The frame in which the bone's dofs turn, relative to the world: axis XYZ turns about x first, so it stands last.
  Quaternion axis() const;
};

/// What an AMC file needs of the skeleton's file; `bones` stand in the order of the skeleton.
struct AsfModel {
  std::vector<AsfBone> bones;
  Skeleton skeleton;
  double unit = 0;     ///< One file unit in metres.
  double radians = 0;  ///< One unit of angle in radians.
};

}  // namespace fragmotion

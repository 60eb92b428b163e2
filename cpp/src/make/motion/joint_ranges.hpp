// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <vector>

#include "motion/clip.hpp"

namespace fragmotion {

/// How a joint's rotation relative to its parent is looked at: as the rotation vector from its mean, rad, along the
/// axes about which the joint turns most, less and least. A knee's first number tells how much it is bent.
struct JointAxes {
  int bone = 0;
  Quaternion mean = Quaternion::Identity();
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  ///< columns

  /// Of rotations [bones, 4].
  Vector3 turn(const double* rotations) const;
};

/// rad: what one sees of a joint that is beyond its range.
constexpr double kSeenExcess = kPi / 180;

/// The least and the greatest of a joint's turns about each axis.
struct TurnRange {
  Vector3 least, greatest;

  TurnRange();  ///< Nothing seen yet.
  void add(const Vector3& turn);
  void add(const TurnRange& other);
  double excess(const Vector3& turn) const;  ///< rad; infinite where nothing was seen
};

/// Calls a function with the rotations [bones, 4] of each pose, each time the same ones.
using EachPose = std::function<void(const std::function<void(const double* rotations)>&)>;

/// The axes of these bones' joints in some poses.
std::vector<JointAxes> joint_axes(const std::vector<int>& bones, const EachPose& each_pose);

using TurnRanges = std::vector<TurnRange>;  // [joints]

/// The ranges of all takes but one.
TurnRanges together(const std::vector<TurnRanges>& by_take, std::size_t joints, std::size_t but);

/// The ranges of some joints in takes, of which it looks at ten poses a second.
class JointRanges {
 public:
  JointRanges(const std::vector<int>& bones, const std::vector<Clip>& clips, int threads = 1);

  /// How far the joint is beyond its range that is furthest beyond, rad.
  double excess(const double* rotations) const;

 private:
  std::vector<JointAxes> joints_;
  TurnRanges ranges_;
};

}  // namespace fragmotion

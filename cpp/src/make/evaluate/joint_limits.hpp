// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "fragments/fragment.hpp"

namespace fragmotion {

/// How far joints turn beyond what was seen of them: the share of all joints in all frames that do so by more than a
/// degree, and the furthest, rad.
struct Excess {
  double share = 0, worst = 0;
};

/// How a joint's rotation relative to its parent is looked at: as the rotation vector from its mean, rad, along the
/// axes about which the joint turns most, less and least. A knee's first number tells how much it is bent.
struct JointAxes {
  int bone = 0;
  Quaternion mean = Quaternion::Identity();
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  ///< columns

  /// Of rotations [bones, 4].
  Vector3 turn(const double* rotations) const;
};

/// The least and the greatest of a joint's turns about each axis.
struct TurnRange {
  Vector3 least, greatest;

  TurnRange();  ///< Nothing seen yet.
  void add(const Vector3& turn);
  void add(const TurnRange& other);
  double excess(const Vector3& turn) const;  ///< rad; infinite where nothing was seen
};

/// The ranges of the joints, which are the measured_bones() below the hips, in the takes and their mirror images.
class JointLimits {
 public:
  explicit JointLimits(const PackedPool& pool);

  /// The fair figure for the takes themselves: each beyond the range of all others. Nothing where there is one only.
  const Excess& takes() const { return takes_; }

  /// A motion's: rotations [frames, bones, 4] as in Clip. Throws std::invalid_argument on another number of bones.
  Excess of(const std::vector<double>& rotations) const;

 private:
  std::size_t width_;  // numbers of a pose
  std::vector<JointAxes> joints_;
  std::vector<TurnRange> ranges_;  // [joints]
  Excess takes_;
};

}  // namespace fragmotion

// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "skeleton/skeleton.hpp"

namespace fragmotion {

/// How a head looks about in takes, seen from where the character faces. Angles in rad.
struct GazeRange {
  Vector3 forward = Vector3::UnitY();  ///< Straight ahead, as the head sees it: where it looks on the mean.
  double turn = 0;                     ///< By so much it turns to either side,
  double chest = 0;                    ///< and of that the chest, no more than the whole.
  double down = 0, up = 0;             ///< Its pitch, down .. up: 0 is level, up is positive.
};

/// How a bone is turned in takes, seen from where the character faces.
class Turned {
 public:
  void add(const Quaternion& seen);
  /// Where it looks on the mean, as it sees it itself.
  Vector3 forward() const;
  /// By how much a direction of its own is turned to a side, of all that were added.
  std::vector<double> turns(const Vector3& direction) const;
  /// How high it points, likewise.
  std::vector<double> pitches(const Vector3& direction) const;
  bool empty() const { return all_.empty(); }

 private:
  std::vector<Eigen::Quaternionf> all_;
};

/// Finds the range of poses, each angle but for the hundredth of their time in which it is beyond, and at least what a
/// head does without effort. All 0 without poses.
class GazeRanges {
 public:
  /// The skeleton has look_bones().
  explicit GazeRanges(const Skeleton& skeleton);
  /// A pose, by its bones' rotations in the world and where the character faces.
  void add(double heading, const std::vector<Quaternion>& world);
  GazeRange range() const;

 private:
  int head_, chest_ = -1;
  Turned head_turned_, chest_turned_;
};

}  // namespace fragmotion

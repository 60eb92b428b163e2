// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "motion/clip.hpp"

namespace fragmotion {

/// How the rotations of a mirror image follow from the original's: that of bone b is before[b] * q * after[b], where q
/// is the original's of bone counterparts[b]. The hips' are in the world, every other bone's in its parent.
struct MirrorTurns {
  std::vector<int> counterparts;  ///< Of each bone; empty where the rotations do not follow one by one.
  std::vector<Quaternion> before, after;
};

/// Turns a motion into its mirror image, left for right. Each bone's frame is reflected and then turned by a constant
/// that makes it a frame of its counterpart: told by the rest pose where that is symmetric, else by the takes' mean
/// pose, which gait makes symmetric, as is a bone that the takes roll by half a turn on one side. Fingers that no take
/// moves are no part of the motion: they stay as they are.
class Mirror {
 public:
  Mirror(const Kinematics& kinematics, const std::vector<Clip>& clips);

  /// The mirror image of one of the takes, reflected in the world's plane x = 0; named "NAME mirrored".
  Clip operator()(const Clip& clip) const;

  /// Empty where a bone and its counterpart do not hang on counterparts.
  MirrorTurns turns() const;

 private:
  void mirror_in_parents(const Clip& clip, const MirrorTurns& turns, Clip& result) const;
  void mirror_in_world(const Clip& clip, Clip& result) const;

  const Kinematics& kinematics_;
  std::vector<int> counterpart_;
  std::vector<int> still_;             // fingers that no take moves, in ascending order
  std::vector<Eigen::Matrix3d> turn_;  // improper: W' = S W_counterpart turn
};

}  // namespace fragmotion

// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "fragmotion/base/simd.hpp"
#include "fragmotion/motion/pose.hpp"
#include "fragmotion/runtime/player_constants.hpp"

namespace fragmotion {

/// How far bones are turned from their motion, as modified Rodrigues parameters, and that a second: x, y and z apart.
struct BoneOffsets {
  float turn[3][kBoneBlock] = {}, turning[3][kBoneBlock] = {};
};

/// A stitch that keeps pose and velocity (D. Bollo, "Inertialization: high-performance animation transitions in Gears
/// of War", GDC 2018): the new motion is shown with the old one's offset and relative speed, which fade like a
/// critically damped spring. (Against Bollo's polynomials and the paper's ease-in-ease-out weights of the same
/// smoothness at the beginning, it is at its fastest little more than half as fast.) It needs nothing of the old motion
/// once it has begun, so it may begin anew at any time. How fast the root goes over the ground is not faded here: that
/// is a body's velocity (pose_correction.hpp).
class Inertialization {
 public:
  explicit Inertialization(int bones, const StitchConstants& constants = {});

  /// Nothing to fade.
  void clear() { end_ = 0; }

  /// Whether anything is left `time` seconds after the beginning.
  bool active(double time) const { return time < end_; }

  /// From `old` to `fresh`: after `seconds` little of the offset is left (StitchConstants), after four times that
  /// nothing. The old motion is also given `apart` seconds before, the new one `apart` seconds later: speeds are those
  /// inside either. Returns how much faster the old root goes over the ground, m/s.
  Vector2 begin(const WorldPose& old_before, const WorldPose& old, const WorldPose& fresh, const WorldPose& fresh_later,
                double apart, double seconds);

  /// Lets its memory be on its way to the processor.
  void prefetch() const { fragmotion::prefetch(blocks_.data(), blocks_.size()); }

  /// Adds what is left `time` seconds after the beginning.
  void apply(double time, WorldPose& pose) const;

 private:
  StitchConstants constants_;
  double damping_ = 0, end_ = 0;  // 1/s, s
  Vector3 root_ = Vector3::Zero(), root_speed_ = Vector3::Zero();
  double heading_ = 0, heading_speed_ = 0;
  int bones_;
  std::vector<BoneOffsets> blocks_;
};

}  // namespace fragmotion

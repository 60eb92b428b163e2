// SPDX-License-Identifier: MIT
#pragma once

#include "runtime/inertialization.hpp"
#include "runtime/workspace.hpp"

namespace fragmotion {

/// s that a stitch of neck and head takes at most.
constexpr double kSlowestStitch = 1;

/// A stitch that lets neck and head, seen from the world, turn no faster to where the new motion has them than in the
/// takes, while the body below is there sooner. Where they would be no faster with the body's own stitch, that is left
/// to them. Does nothing to a skeleton without a head. Allocates nothing once it is made.
class LookStitch {
 public:
  explicit LookStitch(Workspace& workspace) : workspace_(&workspace) {}

  void clear() { damping_ = 0; }
  /// As Inertialization::begin, of a body that is turned by `turning` rad/s beyond its motion and whose stitch `body`
  /// has just begun: offsets of neck and head that fade more slowly are kept there, in the place of those that it has.
  void begin(const WorldPose& old, const WorldPose& old_later, const WorldPose& fresh, const WorldPose& fresh_later,
             double apart, double seconds, double turning, const PackedClip& clip, Inertialization& body);
  /// Turns neck and head as they are `time` seconds after the beginning, in the pose of the clip that was sampled last
  /// with the turns of the body's stitch, and whose heading has not been moved by it.
  void apply(double time, const Inertialization& body, const PackedClip& clip, WorldPose& pose) const;

 private:
  friend struct PlayerState;

  Quaternion turn_below(const std::vector<double>& rotations) const;
  void see(const std::vector<double>& rotations, const Quaternion& after, WorldPose& look) const;
  bool active(double time, const Inertialization& body) const;

  Workspace* workspace_;
  double damping_ = 0;  // 1/s, less than the body's; 0 where nothing is left
};

}  // namespace fragmotion

// SPDX-License-Identifier: MIT
#pragma once

#include "runtime/inertialization.hpp"
#include "runtime/workspace.hpp"

namespace fragmotion {

/// s that a stitch of neck and head takes at most.
constexpr double kSlowestStitch = 1;

/// A stitch that lets neck and head, seen from the world, turn no faster to where the new motion has them than in the
/// takes, while the body below is there sooner. Does nothing to a skeleton without a head. Allocates nothing once it is
/// made.
class LookStitch {
 public:
  explicit LookStitch(Workspace& workspace) : workspace_(&workspace) {}

  void clear() { damping_ = 0; }
  /// As Inertialization::begin, of a body that is turned by `turning` rad/s beyond its motion and whose stitch `body`
  /// has just begun: neck's and head's offsets are kept there, in the place of those that it has of them.
  void begin(const WorldPose& old, const WorldPose& old_later, const WorldPose& fresh, const WorldPose& fresh_later,
             double apart, double seconds, double turning, Inertialization& body);
  /// Adds what is left of the body's stitch and of this one `time` seconds after their beginning.
  void apply(double time, const Inertialization& body, WorldPose& pose) const;

 private:
  friend struct PlayerState;

  void see(const WorldPose& pose, const Quaternion& after, WorldPose& look) const;
  Quaternion turn_below(const WorldPose& pose) const;
  bool active(double time, const Inertialization& body) const;

  Workspace* workspace_;
  double damping_ = 0;  // 1/s, no more than the body's; 0 where nothing is left
};

}  // namespace fragmotion

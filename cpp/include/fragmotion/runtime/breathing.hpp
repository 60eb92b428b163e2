// SPDX-License-Identifier: MIT
#pragma once

#include "fragmotion/motion/pose.hpp"
#include "fragmotion/motion/trunk.hpp"

namespace fragmotion {

/// Lets a body that stands breathe, so that it does not freeze: its chest goes back and forth by a degree, the head
/// stays level. It fades in and out within a second. Does nothing to a skeleton without a chest, the bone that both
/// arms hang from. Allocates nothing once it is made.
class Breathing {
 public:
  explicit Breathing(const Trunk& trunk);

  /// Has not begun.
  void reset();

  /// Changes the pose that is shown `seconds` after the last one, of a body that `stands` or does not.
  void apply(const Skeleton& skeleton, WorldPose& pose, bool stands, double seconds);

 private:
  Trunk trunk_;
  double time_ = 0, depth_ = 0;  // s, 0 .. 1
};

}  // namespace fragmotion

// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "fragmotion/base/types.hpp"

namespace fragmotion {

/// Poses at a fixed rate and where the character is in them.
struct Motion {
  std::vector<double> root_positions;  ///< [frames, 3] m
  std::vector<double> rotations;       ///< [frames, bones, 4] as in Clip
  std::vector<double> places;          ///< [frames, 3]: the character frame's x, y (m) and heading (rad)

  int frames() const { return static_cast<int>(places.size() / 3); }
  int bones() const { return static_cast<int>(rotations.size() / 4) / frames(); }
};

/// The same poses, seen from the character frame, with that frame at `places` [frames, 3]. `hips` is a number of a
/// bone.
Motion carried(const Motion& motion, int hips, const std::vector<double>& places);

/// The motion with its last `count` frames eased so that it ends as it began: seen from the character frame, the last
/// pose is the first one, and the one before leads up to it at the first's velocity; the path's last step is its first.
/// `count` is brought within 2 and the motion's steps; fewer than three frames stay as they are.
Motion looped(const Motion& motion, int hips, int count);

/// A motion that was shown at times (s, ascending from 0) at a fixed rate: straight lines between what was shown.
struct Resampled {
  Motion motion;
  std::vector<int> nearest;  ///< [frames]: of what was shown
};
Resampled resampled(const std::vector<double>& times, const Motion& motion, double rate);

}  // namespace fragmotion

// SPDX-License-Identifier: MIT
#pragma once

#include <functional>

#include "feet/feet_ahead.hpp"
#include "feet/foot_lock.hpp"

namespace fragmotion {

/// How a body goes on, if what plays goes on.
struct Course {
  CharacterFrame frame;                ///< Of what plays now.
  Vector2 velocity = Vector2::Zero();  ///< Of the root beyond what plays: m/s in the character frame,
  double turn_rate = 0;                ///< and rad/s.
  StepEdit steps;
  std::array<bool, 2> stands{};            ///< Whether a foot is held, or is to stand where feet are not,
  std::array<double, 2> until_standing{};  ///< and s until it is to stand.
  std::function<void(double seconds, WorldPose& pose)>
      sample;  ///< What plays in so many seconds, but for neck and head.
};

/// What the feet of a body that is shown so do next. `lock` holds its feet, or is null; `later` has as many rotations
/// as `shown`, and is room to work in.
FeetAhead look_ahead(FootLock::Body& body, const Floors& floors, const FootLock* lock, const Course& course,
                     const WorldPose& shown, WorldPose& later);

}  // namespace fragmotion

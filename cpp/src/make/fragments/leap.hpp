// SPDX-License-Identifier: MIT
#pragma once

#include "fragments/evident.hpp"
#include "fragments/gait_edit.hpp"

namespace fragmotion {

/// A clip with a hop in it, whose flight, frames begin .. end, is a fragment.
struct Leap {
  Clip clip;
  BodyMotion motion;
  int begin = 0, end = 0;
  Control evident;  ///< Ev of its flight
};

/// Of a clip that a hop was added to; `usual` as of evident_control().
Leap leap_of(const Kinematics& kinematics, Clip clip, const Hop& hop, double usual, const ControlSpace& space);

/// Lets a leap fly as fast as the control asks for, where its gait goes faster and slower in each step: what is added
/// to its way is while no foot stands.
void fly_as_fast(const Control& control, Leap& leap);

}  // namespace fragmotion

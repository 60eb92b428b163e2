// SPDX-License-Identifier: MIT
#pragma once

#include "fragmotion/motion/contacts.hpp"
#include "fragmotion/skeleton/two_bone_ik.hpp"

namespace fragmotion {

/// "Simple transforming of the original fragments" (Sec. 4): how the path of a fragment is changed; the body goes
/// along.
struct GaitEdit {
  double direction = 0;  ///< Turns the direction of travel against the body, rad, left is positive.
  double speed = 1;      ///< Scales the path.
  double tempo = 1;      ///< The steps follow each other so much faster.
  double turn = 0;       ///< Turns path and body at this rate, rad/s.
};

/// `frames` + 1 frames that go round and round frames begin .. end of a clip, a gait's cycle, with the path
/// transformed; frame 0 is where `begin` was. With `end` before `begin` the cycle is played backward. Where the cycle
/// does not end as it began, its second half leads there. The strides are turned and scaled with the path: to the
/// side with flat feet, which keep apart rather than cross, as far as 0.2 m a foot allow. Feet that `contacts` (of the
/// clip) say are planted stay planted.
Clip transformed(const Kinematics& kinematics, const Legs& legs, const Clip& clip, const Contacts& contacts, int begin,
                 int end, int frames, const GaitEdit& edit);

/// Makes a hop of frames 0 .. end of a clip: the body goes down over the feet, through the air in a parabola of so many
/// metres with the feet drawn up, and is caught by the knees.
void hop(const Kinematics& kinematics, const Legs& legs, Clip& clip, int end, double height);

}  // namespace fragmotion

// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <vector>

#include "control/control.hpp"
#include "fragments/distance.hpp"
#include "motion/contacts.hpp"

namespace fragmotion {

/// Fragments that follow each other in a take and end nearly as they began: played again and again, they are a gait.
/// Or such as end nearly as their mirror images begin: a step, whose gait is that step and its mirror image in turns.
/// Played backward, they go where they came from, which is a gait where none that is held goes that way.
struct ClosedCycle {
  int clip = 0, begin = 0, end = 0;  ///< Frames.
  int image = -1;                    ///< The clip that is the mirror image, of a step.
  Control evident;                   ///< Of the gait.
  double flaw = 0;  ///< m a metre of reach from its last pose to its first, and from the usual heights; and its haste.

  bool backward() const { return end < begin; }
  bool is_step() const { return image >= 0; }
};

/// What it costs a gait's looks to go in another direction, of which 45 degrees count 1, and to turn at another rate.
double effort_of_direction(const Control& gait, const Control& control);
inline double effort_of_turn(const Control& gait, const Control& control) {
  return 0.5 * std::abs(control.turn - gait.turn);
}
/// And to go so many times as fast, of which 1.5 counts 1: more for what is far more, less for what is slower.
double effort_of_speed(double faster);
/// And a unit of ClosedCycle::flaw.
inline constexpr double kFlawed = kTunedReach;

/// Those of a pool whose fragments have their evident controls, and these trajectories: steps of a gait, walk or run,
/// and what is played backward, only where the takes hold nothing whole of it that goes that way (kSameDirection). Clip
/// c + `takes` is the mirror image of clip c < `takes`, where there is one.
std::vector<ClosedCycle> closed_cycles(const FragmentPool& pool, const Trajectories& trajectories,
                                       const ControlSpace& space, std::size_t takes);

/// A gait that goes round and round frames `begin` .. `end` of a clip.
struct GaitSource {
  Clip clip;
  Contacts contacts;
  int begin = 0, end = 0;
};

/// The gait of a step, forward or backward: the step and its mirror image, which lead to each other. The contacts are
/// those of the two clips.
GaitSource gait_of_step(const Kinematics& kinematics, const FragmentPool& pool, const ClosedCycle& step,
                        const Contacts& contacts, const Contacts& image_contacts);

}  // namespace fragmotion

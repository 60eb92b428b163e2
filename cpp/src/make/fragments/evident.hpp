// SPDX-License-Identifier: MIT
#pragma once

#include "fragments/fragment.hpp"
#include "motion/center_of_mass.hpp"

namespace fragmotion {

/// m of a 1.8 m character that the centre of mass rises over its usual height in a jump.
constexpr double kJumpRise = 0.2;

/// How much less it rises, m, where that is `jump` of a jump.
double missing_rise(double jump);

/// What Ev needs to know of a clip.
struct BodyMotion {
  std::vector<Vector3> center;  ///< [frames] m: the centre of mass
  std::vector<double> heading;  ///< [frames] rad: Clip::headings
  std::vector<bool> in_gait;    ///< [frames] where it is no jump, however high: gait_bounces()
};

BodyMotion body_motion(const Kinematics& kinematics, const Clip& clip);

/// The height of the centre of mass above which a body is in a jump: the median over all clips, m.
double usual_height(const std::vector<BodyMotion>& motions);

/// Ev(f) (Sec. 3.2), "estimated by the center-of-mass motion": mean velocity of the centre of mass in the character
/// frame halfway, mean turn rate over space.turn_rate(), and how much of a jump's rise (8 cm: none, 20 cm: all, of
/// a 1.8 m character) the centre of mass shows above `usual`. What takes off or lands so fast that it would fly, or has
/// flown, as high shows two fifths of a jump: it is neither a step nor the flight.
Control evident_control(const BodyMotion& motion, double rate, int begin, int end, double usual,
                        const ControlSpace& space);

/// Lets what is mostly of a whole jump (whole_jumps.hpp), its crouch or its landing, show no less than what takes off.
void lead_to_jumps(FragmentPool& pool);

}  // namespace fragmotion

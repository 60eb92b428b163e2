// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <vector>

#include "policy/policy.hpp"
#include "policy/quality.hpp"

namespace fragmotion {

/// Whether a velocity is within 45 degrees of a control's direction, and along it no less than half its speed.
inline bool goes_along(double x, double y, const Control& wanted) {
  constexpr double kSlowest = 0.5;  // of the speed that is asked for
  const double along = x * wanted.x + y * wanted.y, across = x * wanted.y - y * wanted.x;
  const bool is_fast = along >= kSlowest * wanted.speed() * wanted.speed(), is_near = along >= std::abs(across);
  return is_fast && is_near;
}

/// Whether what is evident goes as a control asks for that is held: without a jump, within 45 degrees of its direction,
/// and along it at no less than half its speed. What all of some do, their mean does, too.
inline bool answers(const Control& evident, const Control& wanted) {
  return matches_jump(evident, wanted) && goes_along(evident.x, evident.y, wanted);
}

/// [controls]: the control that is performed in place of each. It is itself, but where it asks for motion that no class
/// answers(): then it is the nearest one (ControlDis) that a class does answer, if there is any. `evident`: of the
/// classes' representatives. A class that matches a control by 0 does not play.
std::vector<int> answered_controls(const Quality& quality, const ControlSpace& space,
                                   const std::vector<Control>& evident);

/// Makes a table answer motion with motion, and the control that asks to stand with a stand. Going on joins perfectly,
/// so that Eq. 2 may prefer it to what is asked for, for ever. Where such a control is held and leads into a cycle of
/// classes that does not answer() it on average, or that goes or turns where it asks to stand, each class of the cycle
/// is followed by the one of the greatest quality that leads to an answer instead; and a control of motion that no
/// class answers is performed as answered_controls() says. `bridges`: stand_bridges(), which play in between. A table
/// that is mended stays as it is when it is mended again. `strikes`: of each class, the feet that come down in it, a
/// bit each; -1 of a whole cycle. A cycle answers no motion in which not all feet do that come down in any class, as it
/// glides or hops, unless none can be made of what does answer it.
void answer_motion(Policy& policy, const Quality& quality, const ControlSpace& space,
                   const std::vector<Control>& evident, const std::vector<int>& bridges,
                   const std::vector<int>& strikes);

}  // namespace fragmotion

// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "control/control.hpp"

namespace fragmotion {

/// Eq. 2 as a table. It is a product of one factor that knows no control and one that knows no previous class.
struct Quality {
  int classes = 0;
  std::vector<double> smoothness;  ///< [classes, classes]: 1 / (1 + Dis(last pose of Q, first pose of Q'))
  std::vector<double> match;       ///< [classes, controls]: 1 / (1 + ControlDis(Ev(Q'), c))
  int controls = kPaperPoints;     ///< The points of the control space.

  double operator()(int from, int to, int control) const {
    return smoothness[static_cast<std::size_t>(from) * classes + to] *
           match[static_cast<std::size_t>(to) * controls + control];
  }
};

/// Eq. 2's second factor, [classes, controls], of classes that are evident of these controls.
std::vector<double> control_matches(const std::vector<Control>& evident, const ControlSpace& space);

/// Lets a class match nothing, as one that does not play.
void leave_out(int of_class, Quality& quality);

}  // namespace fragmotion

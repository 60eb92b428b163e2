// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "fragments/fragment.hpp"

namespace fragmotion {

/// ControlDis from a control at which a fragment performs it, at most.
constexpr double kPerformed = 0.3;

/// How well the fragments cover the control space.
struct Coverage {
  std::vector<int> counts;        ///< Fragments whose evident control is nearest to this point.
  std::vector<double> distances;  ///< ControlDis to the nearest fragment's evident control.
};

Coverage coverage(const std::vector<Fragment>& fragments, const ControlSpace& space);

}  // namespace fragmotion

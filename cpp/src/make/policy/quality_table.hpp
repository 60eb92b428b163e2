// SPDX-License-Identifier: MIT
#pragma once

#include "classes/classes.hpp"
#include "fragments/distance.hpp"
#include "policy/quality.hpp"

namespace fragmotion {

/// Eq. 2 for the representatives of the classes.
Quality quality_table(const std::vector<Fragment>& fragments, const Trajectories& t, const Classes& classes,
                      const ControlSpace& space);

}  // namespace fragmotion

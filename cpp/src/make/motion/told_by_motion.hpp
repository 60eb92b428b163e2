// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "motion/take.hpp"

namespace fragmotion {

/// Gives takes the roles of a body on four legs where their skeleton stands on no legs at rest, and on four in what
/// they show: in the mean over all takes of one skeleton, which get the same roles, whichever axis is up. Others stay
/// as they are. Numbers may be missing (not finite).
void tell_four_legs(const std::vector<Take*>& takes);

}  // namespace fragmotion

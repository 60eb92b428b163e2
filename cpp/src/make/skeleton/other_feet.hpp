// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "skeleton/skeleton.hpp"

namespace fragmotion {

/// The bones that end the limbs on which a body stands at rest beside those that end in its feet: a spider's other six.
/// No foot lock holds them.
std::vector<int> other_feet(const Skeleton& skeleton);

}  // namespace fragmotion

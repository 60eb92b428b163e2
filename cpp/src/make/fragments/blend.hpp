// SPDX-License-Identifier: MIT
#pragma once

#include "fragments/fragment.hpp"
#include "skeleton/kinematics.hpp"

namespace fragmotion {

/// A motion between two fragments: each pose, and the path, interpolated at equal phases with weight (1 - w, w). Its
/// last frame but `tail` is the fragments' end. Both at the rate of `a`'s clip.
Clip interpolated(const Kinematics& kinematics, const FragmentPool& pool, const Fragment& a, const Fragment& b,
                  double w, int tail);

}  // namespace fragmotion

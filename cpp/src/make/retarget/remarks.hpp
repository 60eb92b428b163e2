// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "retarget/retarget.hpp"

namespace fragmotion {

/// What a viewer may find fault with in a clip that was retargeted; `scale` times, lengths are of a 1.8 m character.
std::vector<RetargetRemark> remarks_on(const RetargetReport& report, double scale);

}  // namespace fragmotion

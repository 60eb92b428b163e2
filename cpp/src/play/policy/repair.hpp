// SPDX-License-Identifier: MIT
#pragma once

#include "policy/policy.hpp"
#include "policy/quality.hpp"

namespace fragmotion {

/// Makes a learned table do what is asked for. Where its class does not jump though the control does, or the other way
/// round, since Eq. 2 thinks the transition too bad or too good for it, or goes back from where both the class that
/// plays and the control go, which may join best, it takes of the classes that the table leads to the one of the
/// greatest quality times control match that does neither; where there is none the table's stays. `evident`: of the
/// classes' representatives. What is repaired stays as it is when it is repaired again.
void repair_policy(Policy& policy, const Quality& quality, const ControlSpace& space,
                   const std::vector<Control>& evident);

}  // namespace fragmotion

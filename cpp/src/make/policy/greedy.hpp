// SPDX-License-Identifier: MIT
#pragma once

#include "policy/policy.hpp"
#include "policy/quality.hpp"

namespace fragmotion {

/// "Does not care about the future control signals" (Sec. 4): argmax of Eq. 2 at each step. Ties go to the lower class.
Policy greedy_policy(const Quality& quality);

}  // namespace fragmotion

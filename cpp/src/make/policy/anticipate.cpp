// SPDX-License-Identifier: MIT
#include "policy/anticipate.hpp"

namespace fragmotion {

Policy anticipate_policy(const Quality& quality, const std::vector<std::vector<int>>& traces) {
  Policy policy = value_iteration(quality, control_model(traces, kGenericPrior, quality.controls));
  policy.name = "anticipate";
  return policy;
}

}  // namespace fragmotion

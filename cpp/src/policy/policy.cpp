// SPDX-License-Identifier: MIT
#include "fragmotion/policy/policy.hpp"

namespace fragmotion {

double trace_quality(const Quality& quality, const Policy& policy, const std::vector<int>& trace, int start) {
  double sum = 0;
  for (const int control : trace) {
    const int next = policy(start, control);
    sum += quality(start, next, control);
    start = next;
  }
  return sum;
}

double percent_of_optimal(const Quality& quality, const Policy& policy, const std::vector<int>& trace) {
  const OptimalPath optimal = optimal_path(quality, trace);
  if (optimal.quality == 0) return 100;  // nothing is any good
  return 100 * trace_quality(quality, policy, trace, optimal.classes[0]) / optimal.quality;
}

}  // namespace fragmotion

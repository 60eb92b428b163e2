// SPDX-License-Identifier: MIT
#include "policy/greedy.hpp"

namespace fragmotion {

Policy greedy_policy(const Quality& quality) {
  Policy policy{"greedy", quality.classes, {}, quality.controls};
  for (int from = 0; from < quality.classes; ++from) {
    for (int control = 0; control < quality.controls; ++control) {
      int best = 0;
      for (int to = 1; to < quality.classes; ++to) {
        if (quality(from, to, control) > quality(from, best, control)) best = to;
      }
      policy.next.push_back(best);
    }
  }
  return policy;
}

}  // namespace fragmotion

// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <string>

#include "fragmotion/policy/optimal.hpp"

namespace fragmotion {

/// The control policy table (Sec. 3.3): class x control -> next class.
struct Policy {
  std::string name;
  int classes = 0;
  std::vector<int> next;  ///< [classes, 102]

  int operator()(int from, int control) const {
    return next[static_cast<std::size_t>(from) * ControlSpace::kPoints + control];
  }
  /// Whether it ever leads to a class.
  bool leads_to(int k) const { return std::find(next.begin(), next.end(), k) != next.end(); }
};

/// The sum of Eq. 2 along the path that the policy takes from class `start` over a trace of control indices.
double trace_quality(const Quality& quality, const Policy& policy, const std::vector<int>& trace, int start);

/// trace_quality in percent of Optimal's, both from Optimal's Q_0 (Fig. 5).
double percent_of_optimal(const Quality& quality, const Policy& policy, const std::vector<int>& trace);

}  // namespace fragmotion

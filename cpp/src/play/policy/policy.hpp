// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include "control/control.hpp"

namespace fragmotion {

/// The control policy table (Sec. 3.3): class x control -> next class.
struct Policy {
  std::string name;
  int classes = 0;
  std::vector<int> next;        ///< [classes, controls]
  int controls = kPaperPoints;  ///< The points of the control space.

  int operator()(int from, int control) const { return next[static_cast<std::size_t>(from) * controls + control]; }
  /// Whether it ever leads to a class.
  bool leads_to(int k) const { return std::find(next.begin(), next.end(), k) != next.end(); }
};

}  // namespace fragmotion

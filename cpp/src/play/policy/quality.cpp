// SPDX-License-Identifier: MIT
#include "policy/quality.hpp"

#include <algorithm>

namespace fragmotion {

std::vector<double> control_matches(const std::vector<Control>& evident, const ControlSpace& space) {
  std::vector<double> matches;
  matches.reserve(evident.size() * space.size());
  for (const Control& performed : evident) {
    for (int c = 0; c < space.size(); ++c) matches.push_back(1 / (1 + space.distance(performed, space.point(c))));
  }
  return matches;
}

void leave_out(int of_class, Quality& quality) {
  std::fill_n(&quality.match[static_cast<std::size_t>(of_class) * quality.controls], quality.controls, 0.0);
}

}  // namespace fragmotion

// SPDX-License-Identifier: MIT
#include "policy/quality_table.hpp"

namespace fragmotion {

Quality quality_table(const std::vector<Fragment>& fragments, const Trajectories& t, const Classes& classes,
                      const ControlSpace& space) {
  const int n = classes.count;
  Quality quality;
  quality.classes = n;
  quality.controls = space.size();
  quality.smoothness.reserve(static_cast<std::size_t>(n) * n);
  std::vector<Control> evident;
  for (const int k : classes.representatives) evident.push_back(fragments[k].evident);
  quality.match = control_matches(evident, space);
  for (const int from : classes.representatives) {
    for (const int to : classes.representatives) {
      quality.smoothness.push_back(1 / (1 + static_cast<double>(transition_distance(t, from, to))));
    }
  }
  return quality;
}

}  // namespace fragmotion

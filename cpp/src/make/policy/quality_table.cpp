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
  quality.match.reserve(static_cast<std::size_t>(n) * quality.controls);
  for (const int from : classes.representatives) {
    for (const int to : classes.representatives) {
      quality.smoothness.push_back(1 / (1 + static_cast<double>(transition_distance(t, from, to))));
    }
  }
  for (const int to : classes.representatives) {
    for (int c = 0; c < quality.controls; ++c) {
      quality.match.push_back(1 / (1 + space.distance(fragments[to].evident, space.point(c))));
    }
  }
  return quality;
}

}  // namespace fragmotion

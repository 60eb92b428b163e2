// SPDX-License-Identifier: MIT
#include "policy/bridge.hpp"

#include <algorithm>
#include <limits>

namespace fragmotion {

std::vector<int> stand_bridges(const std::vector<Fragment>& fragments, const Trajectories& t, const Classes& classes,
                               const ControlSpace& space, double threshold, const std::vector<bool>& allowed) {
  const std::vector<int>& representatives = classes.representatives;
  const double far = threshold * t.reach;
  std::vector<int> standing;
  for (int k = 0; k < classes.count; ++k) {
    if (space.stands(fragments[representatives[k]].evident) && (allowed.empty() || allowed[k])) standing.push_back(k);
  }
  std::vector<int> bridges;
  for (const int from : representatives) {
    for (const int to : representatives) {
      const double direct = transition_distance(t, from, to);
      int bridge = -1;
      double shortest = std::numeric_limits<double>::infinity();
      for (const int stand : standing) {
        const double there = transition_distance(t, from, representatives[stand]),
                     on = transition_distance(t, representatives[stand], to);
        if (std::max(there, on) < direct && there + on < shortest) shortest = there + on, bridge = stand;
      }
      bridges.push_back(direct > far ? bridge : -1);
    }
  }
  return bridges;
}

}  // namespace fragmotion

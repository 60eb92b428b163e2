// SPDX-License-Identifier: MIT
#include "fragments/coverage.hpp"

#include <algorithm>
#include <limits>

namespace fragmotion {

Coverage coverage(const std::vector<Fragment>& fragments, const ControlSpace& space) {
  Coverage result;
  result.counts.assign(space.size(), 0);
  result.distances.assign(space.size(), std::numeric_limits<double>::infinity());
  for (const Fragment& fragment : fragments) {
    ++result.counts[space.nearest(fragment.evident)];
    for (int c = 0; c < space.size(); ++c) {
      result.distances[c] = std::min(result.distances[c], space.distance(fragment.evident, space.point(c)));
    }
  }
  return result;
}

}  // namespace fragmotion

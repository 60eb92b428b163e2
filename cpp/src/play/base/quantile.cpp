// SPDX-License-Identifier: MIT
#include "base/quantile.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>

namespace fragmotion {

double quantile(std::vector<double> values, double share) {
  assert(!values.empty() && share >= 0 && share <= 1);
  const double at = share * static_cast<double>(values.size() - 1), part = at - std::floor(at);
  const auto below = values.begin() + static_cast<std::ptrdiff_t>(at);
  std::nth_element(values.begin(), below, values.end());
  return part == 0 ? *below : *below + part * (*std::min_element(below + 1, values.end()) - *below);
}

}  // namespace fragmotion

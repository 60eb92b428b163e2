// SPDX-License-Identifier: MIT
#include "fragmotion/optimal.hpp"

#include <algorithm>
#include <stdexcept>

namespace fragmotion {

void check_controls(const std::vector<int>& trace) {
  for (const int control : trace) {
    if (control < 0 || control >= ControlSpace::kPoints) {
      throw std::invalid_argument("control " + std::to_string(control) + " is not one of the 102 points");
    }
  }
}

int best_next(const Quality& quality, int from, const double* match, const double* value, double& best) {
  const double* smoothness = &quality.smoothness[static_cast<std::size_t>(from) * quality.classes];
  int next = 0;
  best = smoothness[0] * match[0] + value[0];
  for (int to = 1; to < quality.classes; ++to) {
    const double candidate = smoothness[to] * match[to] + value[to];
    if (candidate > best) best = candidate, next = to;
  }
  return next;
}

OptimalPath optimal_path(const Quality& quality, const std::vector<int>& trace) {
  if (trace.empty()) throw std::invalid_argument("the trace has no controls");
  check_controls(trace);
  const int n = quality.classes, steps = static_cast<int>(trace.size());
  std::vector<int> next(static_cast<std::size_t>(steps) * n);
  std::vector<double> value(n, 0), earlier(n), match(n);
  for (int i = steps - 1; i >= 0; --i) {
    for (int to = 0; to < n; ++to)
      match[to] = quality.match[static_cast<std::size_t>(to) * ControlSpace::kPoints + trace[i]];
    for (int from = 0; from < n; ++from) {
      next[static_cast<std::size_t>(i) * n + from] =
          best_next(quality, from, match.data(), value.data(), earlier[from]);
    }
    value.swap(earlier);
  }
  OptimalPath path;
  path.classes.push_back(static_cast<int>(std::max_element(value.begin(), value.end()) - value.begin()));
  path.quality = value[path.classes[0]];
  for (int i = 0; i < steps; ++i) path.classes.push_back(next[static_cast<std::size_t>(i) * n + path.classes[i]]);
  return path;
}

}  // namespace fragmotion

// SPDX-License-Identifier: MIT
#include "policy/optimal.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "base/max_accumulate.hpp"
#include "base/transposed.hpp"
#include "base/vectorised.hpp"

namespace fragmotion {

void check_controls(const std::vector<int>& trace, int controls) {
  for (const int control : trace) {
    if (control < 0 || control >= controls) {
      throw std::invalid_argument("control " + std::to_string(control) + " is not one of the " +
                                  std::to_string(controls) + " points");
    }
  }
}

FRAGMOTION_VECTORISED void max_accumulate(double* best, const double* row, int count, double match, double value) {
  for (int i = 0; i < count; ++i) {
    const double candidate = row[i] * match + value;
    best[i] = candidate > best[i] ? candidate : best[i];
  }
}

NextClass::NextClass(const Quality& quality)
    : classes_(quality.classes), smoothness_(transposed(quality.smoothness, classes_, classes_)) {
  for (auto row = smoothness_.begin(); row != smoothness_.end(); row += classes_) {
    const auto [least, most] = std::minmax_element(row, row + classes_);
    roughest_.push_back(*least);
    smoothest_.push_back(*most);
  }
}

// Calls take(Q') in order, but for classes whose sum is under that of another one after any class: few are left.
template <typename Take>
void NextClass::contenders(const double* match, const double* value, const Take& take) const {
  double least = -INFINITY;
  for (int to = 0; to < classes_; ++to) least = std::max(least, roughest_[to] * match[to] + value[to]);
  for (int to = 0; to < classes_; ++to) {
    if (smoothest_[to] * match[to] + value[to] >= least) take(to);
  }
}

void NextClass::values(const double* match, const double* value, double* best) const {
  std::fill_n(best, classes_, -INFINITY);
  contenders(match, value, [&](int to) { max_accumulate(best, after_all(to), classes_, match[to], value[to]); });
}

void NextClass::values(const double* match, const double* value, double* best, int* next) const {
  std::fill_n(best, classes_, -INFINITY);
  contenders(match, value, [&](int to) {
    const double *row = after_all(to), m = match[to], v = value[to];
    for (int from = 0; from < classes_; ++from) {
      const double candidate = row[from] * m + v;
      if (candidate > best[from]) best[from] = candidate, next[from] = to;
    }
  });
}

int NextClass::after(int from, const double* match, const double* value) const {
  int next = 0;
  double best = -INFINITY;
  contenders(match, value, [&](int to) {
    const double candidate = after_all(to)[from] * match[to] + value[to];
    if (candidate > best) best = candidate, next = to;
  });
  return next;
}

OptimalPath optimal_path(const Quality& quality, const std::vector<int>& trace) {
  if (trace.empty()) throw std::invalid_argument("the trace has no controls");
  check_controls(trace, quality.controls);
  const std::size_t n = quality.classes, steps = trace.size();
  const NextClass next(quality);
  const std::vector<double> matches = transposed(quality.match, quality.classes, quality.controls);
  const auto match = [&](std::size_t step) { return &matches[trace[step] * n]; };
  std::vector<double> values((steps + 1) * n, 0);  // of each class before each step and after the last one
  for (std::size_t i = steps; i-- > 0;) next.values(match(i), &values[(i + 1) * n], &values[i * n]);
  OptimalPath path;
  path.classes.push_back(static_cast<int>(std::max_element(values.begin(), values.begin() + n) - values.begin()));
  path.quality = values[path.classes[0]];
  for (std::size_t i = 0; i < steps; ++i) {
    path.classes.push_back(next.after(path.classes[i], match(i), &values[(i + 1) * n]));
  }
  return path;
}

double trace_quality(const Quality& quality, const Policy& policy, const std::vector<int>& trace, int start) {
  double sum = 0;
  for (const int control : trace) {
    const int next = policy(start, control);
    sum += quality(start, next, control);
    start = next;
  }
  return sum;
}

double percent_of_optimal(const Quality& quality, const Policy& policy, const std::vector<int>& trace) {
  const OptimalPath optimal = optimal_path(quality, trace);
  if (optimal.quality == 0) return 100;  // nothing is any good
  return 100 * trace_quality(quality, policy, trace, optimal.classes[0]) / optimal.quality;
}

}  // namespace fragmotion

// SPDX-License-Identifier: MIT
#include "policy/optimal.hpp"

#include <algorithm>
#include <limits>
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

namespace {

constexpr int kTogether =
    20;  // classes whose sums are found at a time, in registers; 100, the usual number, are whole blocks
constexpr double kNone = -std::numeric_limits<double>::infinity();

// The greatest sum of each row of [count, kTogether], whose number is told as well.
FRAGMOTION_VECTORISED void greatest_sums(const double* rows, int count, const double* match, const double* value,
                                         double* best, double* next) {
  double most[kTogether], at[kTogether] = {};
  std::fill_n(most, kTogether, kNone);
  for (int to = 0; to < count; ++to, rows += kTogether) {
    const double m = match[to], v = value[to], number = to;
    for (int i = 0; i < kTogether; ++i) {
      const double candidate = rows[i] * m + v;
      at[i] = candidate > most[i] ? number : at[i];
      most[i] = candidate > most[i] ? candidate : most[i];
    }
  }
  std::copy_n(most, kTogether, best);
  std::copy_n(at, kTogether, next);
}

FRAGMOTION_VECTORISED void greatest_sums(const double* rows, int count, const double* match, const double* value,
                                         double* best) {
  double most[kTogether];
  std::fill_n(most, kTogether, kNone);
  for (int to = 0; to < count; ++to, rows += kTogether) {
    const double m = match[to], v = value[to];
    for (int i = 0; i < kTogether; ++i) {
      const double candidate = rows[i] * m + v;
      most[i] = candidate > most[i] ? candidate : most[i];
    }
  }
  std::copy_n(most, kTogether, best);
}

}  // namespace

NextClass::NextClass(const Quality& quality) : classes_(quality.classes) {
  for (int first = 0; first < classes_; first += kTogether) {
    for (int to = 0; to < classes_; ++to) {
      for (int from = first; from < first + kTogether; ++from) {
        const std::size_t at = static_cast<std::size_t>(std::min(from, classes_ - 1)) * classes_ + to;
        smoothness_.push_back(quality.smoothness[at]);
      }
    }
  }
}

void NextClass::values(const double* match, const double* value, double* best) const {
  double sums[kTogether];
  for (int first = 0; first < classes_; first += kTogether) {
    greatest_sums(&smoothness_[static_cast<std::size_t>(first) * classes_], classes_, match, value, sums);
    std::copy_n(sums, std::min(kTogether, classes_ - first), best + first);
  }
}

void NextClass::values(const double* match, const double* value, double* best, int* next) const {
  double sums[kTogether], numbers[kTogether];
  for (int first = 0; first < classes_; first += kTogether) {
    greatest_sums(&smoothness_[static_cast<std::size_t>(first) * classes_], classes_, match, value, sums, numbers);
    std::copy_n(sums, std::min(kTogether, classes_ - first), best + first);
    std::copy_n(numbers, std::min(kTogether, classes_ - first), next + first);
  }
}

int NextClass::after(int from, const double* match, const double* value) const {
  const double* row =
      &smoothness_[static_cast<std::size_t>(from / kTogether) * kTogether * classes_ + from % kTogether];
  int next = 0;
  double best = kNone;
  for (int to = 0; to < classes_; ++to, row += kTogether) {
    const double candidate = *row * match[to] + value[to];
    if (candidate > best) best = candidate, next = to;
  }
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

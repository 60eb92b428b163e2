// SPDX-License-Identifier: MIT
#include "fragmotion/iterate.hpp"

#include <algorithm>
#include <cmath>

namespace fragmotion {
namespace {

constexpr int kPoints = ControlSpace::kPoints;
constexpr double kStay = 0.5;  // of a count

// For every class Q' and control c, what choosing Q' under c promises beyond its transition.
std::vector<double> expected(const std::vector<double>& model, const std::vector<double>& value, int classes,
                             double discount) {
  std::vector<double> result(value.size(), 0);
  for (int c = 0; c < kPoints; ++c) {
    for (int next = 0; next < kPoints; ++next) {
      const double p = discount * model[c * kPoints + next];
      if (p == 0) continue;
      for (int q = 0; q < classes; ++q) result[c * classes + q] += p * value[next * classes + q];
    }
  }
  return result;
}

}  // namespace

std::vector<double> control_model(const std::vector<std::vector<int>>& traces) {
  std::vector<double> model(kPoints * kPoints, 0);
  for (const std::vector<int>& trace : traces) {
    for (std::size_t i = 1; i < trace.size(); ++i) ++model[trace[i - 1] * kPoints + trace[i]];
  }
  for (int c = 0; c < kPoints; ++c) {
    double* row = &model[c * kPoints];
    row[c] += kStay;
    double sum = 0;
    for (int next = 0; next < kPoints; ++next) sum += row[next];
    for (int next = 0; next < kPoints; ++next) row[next] /= sum;
  }
  return model;
}

Policy iterate_policy(const Quality& quality, const std::vector<std::vector<int>>& traces,
                      const IterateOptions& options) {
  const int n = quality.classes;
  const std::vector<double> model = control_model(traces);
  Policy policy{"iterate", n, std::vector<int>(static_cast<std::size_t>(n) * kPoints)};
  std::vector<double> value(static_cast<std::size_t>(n) * kPoints, 0), match(n);  // value is [102, classes]
  double change = options.tolerance + 1;
  while (change > options.tolerance) {
    const std::vector<double> promise = expected(model, value, n, options.discount);
    change = 0;
    for (int c = 0; c < kPoints; ++c) {
      for (int q = 0; q < n; ++q) match[q] = quality.match[static_cast<std::size_t>(q) * kPoints + c];
      for (int from = 0; from < n; ++from) {
        double best = 0;
        policy.next[static_cast<std::size_t>(from) * kPoints + c] =
            best_next(quality, from, match.data(), &promise[static_cast<std::size_t>(c) * n], best);
        change = std::max(change, std::abs(best - value[static_cast<std::size_t>(c) * n + from]));
        value[static_cast<std::size_t>(c) * n + from] = best;
      }
    }
  }
  return policy;
}

}  // namespace fragmotion

// SPDX-License-Identifier: MIT
#include "fragmotion/iterate.hpp"

#include <algorithm>
#include <cmath>

namespace fragmotion {
namespace {

constexpr int kPoints = ControlSpace::kPoints;

using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

Eigen::Map<const Matrix> as_matrix(const std::vector<double>& values, int rows) {
  return {values.data(), rows, static_cast<Eigen::Index>(values.size()) / rows};
}

}  // namespace

Policy value_iteration(const Quality& quality, const std::vector<double>& model, const IterateOptions& options) {
  const int n = quality.classes;
  Policy policy{"iterate", n, std::vector<int>(static_cast<std::size_t>(n) * kPoints)};
  std::vector<double> value(static_cast<std::size_t>(n) * kPoints, 0), match(n);  // value is [102, classes]
  double change = options.tolerance + 1;
  while (change > options.tolerance) {
    const Matrix promise = options.discount * as_matrix(model, kPoints) * as_matrix(value, kPoints);
    change = 0;
    for (int c = 0; c < kPoints; ++c) {
      for (int q = 0; q < n; ++q) match[q] = quality.match[static_cast<std::size_t>(q) * kPoints + c];
      for (int from = 0; from < n; ++from) {
        double best = 0;
        policy.next[static_cast<std::size_t>(from) * kPoints + c] =
            best_next(quality, from, match.data(), promise.row(c).data(), best);
        change = std::max(change, std::abs(best - value[static_cast<std::size_t>(c) * n + from]));
        value[static_cast<std::size_t>(c) * n + from] = best;
      }
    }
  }
  return policy;
}

Policy iterate_policy(const Quality& quality, const std::vector<std::vector<int>>& traces,
                      const IterateOptions& options) {
  return value_iteration(quality, control_model(traces, kKept), options);
}

}  // namespace fragmotion

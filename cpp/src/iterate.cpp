// SPDX-License-Identifier: MIT
#include "fragmotion/iterate.hpp"

#include <algorithm>
#include <cmath>

namespace fragmotion {
namespace {

constexpr int kPoints = ControlSpace::kPoints;
constexpr double kPrior = 10;  // counts

using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

Eigen::Map<const Matrix> as_matrix(const std::vector<double>& values, int rows) {
  return {values.data(), rows, static_cast<Eigen::Index>(values.size()) / rows};
}

// The share of the steps of all traces in which the control stays; all where there are no steps.
double staying_share(const std::vector<double>& counts) {
  const double steps = as_matrix(counts, kPoints).sum();
  return steps > 0 ? as_matrix(counts, kPoints).trace() / steps : 1;
}

}  // namespace

std::vector<double> control_model(const std::vector<std::vector<int>>& traces) {
  std::vector<double> model(kPoints * kPoints, 0);
  for (const std::vector<int>& trace : traces) {
    for (std::size_t i = 1; i < trace.size(); ++i) ++model[trace[i - 1] * kPoints + trace[i]];
  }
  const double stay = staying_share(model);
  Eigen::Map<Matrix> counts(model.data(), kPoints, kPoints);
  counts.array() += kPrior * (1 - stay) / kPoints;
  counts.diagonal().array() += kPrior * stay;
  counts.array().colwise() /= counts.rowwise().sum().array().eval();
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

}  // namespace fragmotion

// SPDX-License-Identifier: MIT
#include "policy/iterate.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "base/transposed.hpp"
#include "policy/optimal.hpp"

namespace fragmotion {
namespace {

constexpr double kValueTolerance = 1e-6;
constexpr int kMostSweeps = 10000;

using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

void add(std::vector<double>& sums, std::size_t at, double weight, const double* values, int count) {
  for (int i = 0; i < count; ++i) sums[at + i] += weight * values[i];
}

// What is to be expected after each control: products with P(c' | c). Most entries of a row are its smallest one, the
// rest of the prior; only the others are multiplied one by one.
class Expectation {
 public:
  Expectation(const std::vector<double>& model, int controls) : controls_(controls), least_(controls), more_(controls) {
    for (int c = 0; c < controls; ++c) {
      const double* row = &model[static_cast<std::size_t>(c) * controls];
      least_[c] = *std::min_element(row, row + controls);
      for (int next = 0; next < controls; ++next) {
        if (row[next] > least_[c]) more_[c].emplace_back(next, row[next] - least_[c]);
      }
    }
  }

  // The sums over c' of P(c' | c) values(c'); both are [controls, count].
  std::vector<double> of(const std::vector<double>& values, int count) const {
    const auto after = [&](int c) { return &values[static_cast<std::size_t>(c) * count]; };
    std::vector<double> total(count, 0), sums(values.size(), 0);
    for (int c = 0; c < controls_; ++c) add(total, 0, 1, after(c), count);
    for (int c = 0; c < controls_; ++c) {
      const std::size_t at = static_cast<std::size_t>(c) * count;
      add(sums, at, least_[c], total.data(), count);
      for (const auto& [next, more] : more_[c]) add(sums, at, more, after(next), count);
    }
    return sums;
  }

 private:
  int controls_;
  std::vector<double> least_;
  std::vector<std::vector<std::pair<int, double>>> more_;
};

void check(const IterateOptions& options) {
  if (!(options.discount >= 0 && options.discount < 1)) {
    throw std::invalid_argument("the discount must be 0 or more and under 1");
  }
  if (!(options.tolerance > 0 && options.tolerance <= 1)) {
    throw std::invalid_argument("the tolerance must be over 0 and at most 1");
  }
}

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
  return largest;
}

}  // namespace

Policy value_iteration(const Quality& quality, const std::vector<double>& model, const IterateOptions& options) {
  check(options);
  const int n = quality.classes, controls = quality.controls;
  const NextClass next(quality);
  const Expectation expectation(model, controls);
  const std::vector<double> matches = transposed(quality.match, n, controls);
  std::vector<double> value(matches.size(), 0), promise, before;  // [controls, classes]
  const auto of = [&](auto& values, int c) { return &values[static_cast<std::size_t>(c) * n]; };
  for (int sweep = 0; sweep < kMostSweeps; ++sweep) {
    promise = expectation.of(value, n);
    for (double& sum : promise) sum *= options.discount;
    before = value;
    for (int c = 0; c < controls; ++c) next.values(of(matches, c), of(promise, c), of(value, c));
    if (largest_difference(value, before) <= options.tolerance) break;
  }
  Policy policy{"iterate", n, {}, controls};
  for (int from = 0; from < n; ++from) {
    for (int c = 0; c < controls; ++c) policy.next.push_back(next.after(from, of(matches, c), of(promise, c)));
  }
  return policy;
}

Policy iterate_policy(const Quality& quality, const std::vector<std::vector<int>>& traces,
                      const IterateOptions& options) {
  return value_iteration(quality, control_model(traces, kPersistencePrior, quality.controls), options);
}

std::vector<double> future_values(const Quality& quality, const Policy& policy, const std::vector<double>& model) {
  const int n = quality.classes, controls = quality.controls;
  const Matrix steps = IterateOptions().discount * Eigen::Map<const Matrix>(model.data(), controls, controls);
  Matrix value = Matrix::Zero(controls, n), future_value = value;
  double change = 1;
  while (change > kValueTolerance) {
    future_value = steps * value;
    change = 0;
    for (int c = 0; c < controls; ++c) {
      for (int from = 0; from < n; ++from) {
        const int next = policy(from, c);
        const double better = quality(from, next, c) + future_value(c, next);
        change = std::max(change, std::abs(better - value(c, from)));
        value(c, from) = better;
      }
    }
  }
  return {future_value.data(), future_value.data() + future_value.size()};
}

}  // namespace fragmotion

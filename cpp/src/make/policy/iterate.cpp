// SPDX-License-Identifier: MIT
#include "policy/iterate.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "base/rounding.hpp"
#include "base/transposed.hpp"
#include "policy/optimal.hpp"

namespace fragmotion {
namespace {

constexpr int kMostSweeps = 10000;
// Sweeps that keep the decisions of the last one, which takes a fifth of deciding: modified policy iteration (Puterman
// and Shin, "Modified policy iteration algorithms for discounted Markov decision problems", Management Science 24,
// 1978).
constexpr int kHeld = 10;

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

// Values [controls, classes] and what is decided by them.
class Iteration {
 public:
  Iteration(const Quality& quality, const std::vector<double>& model, double discount)
      : quality_(quality),
        next_(quality),
        expectation_(model, quality.controls),
        discount_(discount),
        matches_(transposed(quality.match, quality.classes, quality.controls)),
        value_(matches_.size(), 0),
        chosen_(matches_.size()) {}

  // Decides anew; returns the largest change of a value.
  double decide() {
    expect();
    const std::vector<double> before = value_;
    for (std::size_t c = 0; c < value_.size(); c += quality_.classes) {
      next_.values(&matches_[c], &promise_[c], &value_[c], &chosen_[c]);
    }
    return largest_difference(value_, before);
  }

  // What the values become where the decisions are kept.
  void go_on() {
    expect();
    const int n = quality_.classes;
    for (int c = 0; c < quality_.controls; ++c) {
      const std::size_t row = static_cast<std::size_t>(c) * n;
      for (int from = 0; from < n; ++from) {
        const int to = chosen_[row + from];
        value_[row + from] = quality_(from, to, c) + promise_[row + to];
      }
    }
  }

  // [classes, controls]
  std::vector<int> chosen() const { return transposed(chosen_, quality_.controls, quality_.classes); }

 private:
  void expect() {
    promise_ = expectation_.of(value_, quality_.classes);
    for (double& sum : promise_) sum *= discount_;
  }

  const Quality& quality_;
  NextClass next_;
  Expectation expectation_;
  double discount_;
  std::vector<double> matches_, value_, promise_;
  std::vector<int> chosen_;
};

}  // namespace

Policy value_iteration(const Quality& quality, const std::vector<double>& model, const IterateOptions& options) {
  check(options);
  Iteration iteration(quality, model, options.discount);
  for (int sweep = 0; sweep < kMostSweeps && iteration.decide() > options.tolerance; ++sweep) {
    for (int held = 0; held < kHeld; ++held) iteration.go_on();
  }
  return {"iterate", quality.classes, iteration.chosen(), quality.controls};
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
  while (change > kFloatRounding) {
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

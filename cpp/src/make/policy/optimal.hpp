// SPDX-License-Identifier: MIT
#pragma once

#include "policy/policy.hpp"
#include "policy/quality.hpp"

namespace fragmotion {

/// Throws std::invalid_argument on a control index outside 0 .. controls - 1.
void check_controls(const std::vector<int>& trace, int controls);

/// The choice of the next class Q' by Quality(Q, Q', c) + value(Q') (Eqs. 1 and 4), for one table of qualities. `match`
/// is the second factor of Eq. 2 for c, 0 or more, `value` what each class is worth afterwards, both [classes].
/// The same bits on every x86-64, with AVX2 or without.
class NextClass {
 public:
  explicit NextClass(const Quality& quality);

  /// The greatest sum after each class, to `best` [classes].
  void values(const double* match, const double* value, double* best) const;

  /// Also the classes with these sums, to `next` [classes]. Ties go to the lower class.
  void values(const double* match, const double* value, double* best, int* next) const;

  /// The class with the greatest sum after `from`. Ties go to the lower class.
  int after(int from, const double* match, const double* value) const;

 private:
  template <typename Take>
  void contenders(const double* match, const double* value, const Take& take) const;
  const double* after_all(int to) const { return &smoothness_[static_cast<std::size_t>(to) * classes_]; }

  int classes_;
  std::vector<double> smoothness_;            // [Q', Q],
  std::vector<double> roughest_, smoothest_;  // [Q'] the least and the greatest of a row
};

/// The best path in hindsight: Q_0 and the class after each of the trace's controls, and the sum of Eq. 2 along it.
struct OptimalPath {
  std::vector<int> classes;  ///< [steps + 1]
  double quality = 0;
};

/// Dynamic programming over a trace of control indices (Eqs. 1, 3 and 4): O(steps classes^2).
/// Ties go to the lower class. Throws std::invalid_argument on an empty trace or an index outside the quality's
/// controls.
OptimalPath optimal_path(const Quality& quality, const std::vector<int>& trace);

/// The sum of Eq. 2 along the path that the policy takes from class `start` over a trace of control indices.
double trace_quality(const Quality& quality, const Policy& policy, const std::vector<int>& trace, int start);

/// trace_quality in percent of Optimal's, both from Optimal's Q_0 (Fig. 5).
double percent_of_optimal(const Quality& quality, const Policy& policy, const std::vector<int>& trace);

}  // namespace fragmotion

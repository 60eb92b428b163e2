// SPDX-License-Identifier: MIT
#pragma once

#include "fragmotion/policy.hpp"

namespace fragmotion {

/// P(c' | c) learned from traces: transition counts, and a prior of ten counts, so that a control that a trace rarely
/// visits is expected to behave as controls do on the whole: it stays with the share of all steps in which the control
/// stayed, and else goes anywhere. [102, 102], rows sum to 1.
std::vector<double> control_model(const std::vector<std::vector<int>>& traces);

struct IterateOptions {
  double discount = 0.9;    ///< Of the quality a step later.
  double tolerance = 1e-4;  ///< Iteration ends when no value changes by more.
};

/// Value iteration with a control model (McCann and Pollard, "Responsive characters from motion fragments", SIGGRAPH
/// 2007): V(Q, c) = max over Q' of Quality(Q, Q', c) + discount * sum over c' of P(c' | c) V(Q', c').
/// Ties go to the lower class.
Policy iterate_policy(const Quality& quality, const std::vector<std::vector<int>>& traces,
                      const IterateOptions& options = {});

}  // namespace fragmotion

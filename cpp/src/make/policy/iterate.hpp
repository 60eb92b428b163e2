// SPDX-License-Identifier: MIT
#pragma once

#include "policy/control_model.hpp"
#include "policy/policy.hpp"
#include "policy/quality.hpp"

namespace fragmotion {

struct IterateOptions {
  double discount = 0.9;    ///< Of the quality a step later: 0 or more, under 1.
  double tolerance = 1e-4;  ///< Iteration ends when no value changes by more; over 0, up to 1.
};

/// Value iteration with a control model [controls, controls] (McCann and Pollard, "Responsive characters from motion
/// fragments", SIGGRAPH 2007): V(Q, c) = max over Q' of Quality(Q, Q', c) + discount * sum over c' of P(c' | c) V(Q',
/// c'). Ties go to the lower class. Throws std::invalid_argument on an option that is out of its range.
Policy value_iteration(const Quality& quality, const std::vector<double>& model, const IterateOptions& options = {});

/// McCann and Pollard's prior: a control that was never seen is kept.
constexpr ControlPrior kPersistencePrior{0.5, 0};

/// value_iteration with the control model of traces and kPersistencePrior.
Policy iterate_policy(const Quality& quality, const std::vector<std::vector<int>>& traces,
                      const IterateOptions& options = {});

/// Eq. 2 expected of all steps after each control and class [controls, classes], discounted, where the policy goes on
/// choosing and the controls follow the model [controls, controls].
std::vector<double> future_values(const Quality& quality, const Policy& policy, const std::vector<double>& model);

}  // namespace fragmotion

// SPDX-License-Identifier: MIT
#include "fragmotion/policy/control_model.hpp"

#include <algorithm>
#include <numeric>
#include <stdexcept>

#include "fragmotion/policy/optimal.hpp"

namespace fragmotion {
namespace {

constexpr double kMostCounts = 1e9;  // three years of a joystick

}  // namespace

std::vector<double> control_model(const std::vector<std::vector<int>>& traces, const ControlPrior& prior) {
  constexpr std::size_t kPoints = ControlSpace::kPoints;
  for (const double counts : {prior.stays, prior.goes_anywhere}) {
    if (!(counts >= 0 && counts <= kMostCounts))
      throw std::invalid_argument("the counts of a prior must be 0 to a thousand million");
  }
  std::vector<double> model(kPoints * kPoints, prior.goes_anywhere / kPoints);
  for (std::size_t c = 0; c < kPoints; ++c) model[c * kPoints + c] += prior.stays;
  for (const std::vector<int>& trace : traces) {
    check_controls(trace);
    for (std::size_t i = 1; i < trace.size(); ++i) ++model[trace[i - 1] * kPoints + trace[i]];
  }
  for (std::size_t c = 0; c < kPoints; ++c) {
    double* row = &model[c * kPoints];
    const double sum = std::accumulate(row, row + kPoints, 0.0);
    if (sum > 0)
      std::for_each(row, row + kPoints, [&](double& p) { p /= sum; });
    else
      row[c] = 1;
  }
  return model;
}

}  // namespace fragmotion

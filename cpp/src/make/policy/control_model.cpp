// SPDX-License-Identifier: MIT
#include "policy/control_model.hpp"

#include <algorithm>
#include <numeric>
#include <stdexcept>

#include "policy/optimal.hpp"

namespace fragmotion {
namespace {

constexpr double kMostCounts = 1e9;  // three years of a joystick

}  // namespace

std::vector<double> control_model(const std::vector<std::vector<int>>& traces, const ControlPrior& prior,
                                  int controls) {
  const std::size_t points = controls;
  for (const double counts : {prior.stays, prior.goes_anywhere}) {
    if (!(counts >= 0 && counts <= kMostCounts))
      throw std::invalid_argument("the counts of a prior must be 0 to a thousand million");
  }
  std::vector<double> model(points * points, prior.goes_anywhere / controls);
  for (std::size_t c = 0; c < points; ++c) model[c * points + c] += prior.stays;
  for (const std::vector<int>& trace : traces) {
    check_controls(trace, controls);
    for (std::size_t i = 1; i < trace.size(); ++i) ++model[trace[i - 1] * points + trace[i]];
  }
  for (std::size_t c = 0; c < points; ++c) {
    double* row = &model[c * points];
    const double sum = std::accumulate(row, row + points, 0.0);
    if (sum > 0)
      std::for_each(row, row + points, [&](double& p) { p /= sum; });
    else
      row[c] = 1;
  }
  return model;
}

}  // namespace fragmotion

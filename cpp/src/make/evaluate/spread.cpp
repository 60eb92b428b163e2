// SPDX-License-Identifier: MIT
#include "evaluate/spread.hpp"

#include <algorithm>
#include <utility>

#include "base/quantile.hpp"
#include "runtime/lean.hpp"

namespace fragmotion {

Spread spread(std::vector<double> values) {
  if (values.empty()) return {};
  return {median(values), quantile(values, 0.99), quantile(values, 0.999), quantile(std::move(values), 1)};
}

Pushes pushes(std::vector<double> accelerations) {
  if (accelerations.empty()) return {};
  const auto hard = std::count_if(accelerations.begin(), accelerations.end(), [](double a) { return a > kHard; });
  const auto count = static_cast<double>(accelerations.size());
  return {spread(std::move(accelerations)), static_cast<double>(hard) / count};
}

}  // namespace fragmotion

// SPDX-License-Identifier: MIT
#include "fragmotion/evaluate/spread.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace fragmotion {
namespace {

constexpr double kHard = 6;  // m/s^2

double percentile(std::vector<double>& values, double share) {
  const auto i = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), i, values.end());
  return *i;
}

}  // namespace

Spread spread(std::vector<double> values) {
  if (values.empty()) return {};
  return {percentile(values, 0.5), percentile(values, 0.99), percentile(values, 0.999), percentile(values, 1)};
}

Pushes pushes(std::vector<double> accelerations) {
  if (accelerations.empty()) return {};
  const auto hard = std::count_if(accelerations.begin(), accelerations.end(), [](double a) { return a > kHard; });
  const auto count = static_cast<double>(accelerations.size());
  return {spread(std::move(accelerations)), static_cast<double>(hard) / count};
}

}  // namespace fragmotion

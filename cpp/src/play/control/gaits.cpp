// SPDX-License-Identifier: MIT
#include "control/gaits.hpp"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <limits>

namespace fragmotion {
namespace {

double misfit(const std::vector<double>& values, const std::vector<double>& slots, const std::vector<int>& chosen) {
  double product = 1;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double ratio = values[i] / slots[chosen[i]];
    product *= std::max(ratio, 1 / ratio);
  }
  return product;
}

}  // namespace

std::vector<int> matched(const std::vector<double>& values, const std::vector<double>& slots) {
  std::vector<bool> taken(slots.size(), false);  // in all ways, of which there are few
  std::fill_n(taken.begin(), values.size(), true);
  std::vector<int> best;
  double least = std::numeric_limits<double>::infinity();
  do {
    std::vector<int> chosen;
    for (std::size_t i = 0; i < slots.size(); ++i) {
      if (taken[i]) chosen.push_back(static_cast<int>(i));
    }
    const double off = misfit(values, slots, chosen);
    if (off < least || best.empty()) least = off, best = chosen;
  } while (std::prev_permutation(taken.begin(), taken.end()));
  return best;
}

std::vector<int> gaits_of(const std::vector<double>& speeds) {
  if (speeds.size() == 2) return {kWalk, kRun};
  std::vector<double> usual;
  for (const Gait& gait : kGaits) usual.push_back(gait.speed);
  return matched(speeds, usual);
}

}  // namespace fragmotion

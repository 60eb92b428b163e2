// SPDX-License-Identifier: MIT
#include "evaluate/foot_clearance.hpp"

#include <algorithm>

#include "base/quantile.hpp"

namespace fragmotion {
namespace {

constexpr std::size_t kKnown = 32;  // speeds, each that of as many moments more

}  // namespace

FootClearance::FootClearance(std::vector<Moment> moments) {
  std::sort(moments.begin(), moments.end(), [](const Moment& a, const Moment& b) { return a.speed < b.speed; });
  std::vector<double> heights;
  for (const Moment& moment : moments) heights.push_back(moment.height);
  const std::size_t count = moments.size(), known = std::min(kKnown, count);
  for (std::size_t i = 0; i < known; ++i) {
    const std::size_t first = i * count / known;
    const auto faster = heights.begin() + static_cast<std::ptrdiff_t>(first);
    known_.push_back({moments[first].speed, std::max(0.0, quantile({faster, heights.end()}, kUnderFloor))});
  }
}

double FootClearance::at(double speed) const {
  const auto next = std::upper_bound(known_.begin(), known_.end(), speed,
                                     [](double value, const Moment& moment) { return value < moment.speed; });
  if (next == known_.begin()) return 0;
  const Moment& slower = next[-1];
  if (next == known_.end()) return slower.height;
  return slower.height + (speed - slower.speed) / (next->speed - slower.speed) * (next->height - slower.height);
}

}  // namespace fragmotion

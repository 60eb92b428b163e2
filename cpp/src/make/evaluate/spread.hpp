// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

namespace fragmotion {

/// The median, the 99th and 99.9th percentile and the greatest of some values; 0 where there are none.
struct Spread {
  double p50 = 0, p99 = 0, p999 = 0, worst = 0;
};

Spread spread(std::vector<double> values);

/// How hard a body is pushed along the ground: the change over 0.2 s of its mean velocity over 0.2 s, m/s^2. A body can
/// push itself by some 5, a sprinter's start is 6, and near 8 a shoe slips.
struct Pushes : Spread {
  double over_6 = 0;  ///< Share of the time in which it is more than 6 m/s^2.
};

/// Of accelerations in m/s^2 of a 1.8 m character.
Pushes pushes(std::vector<double> accelerations);

}  // namespace fragmotion

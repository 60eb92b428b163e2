// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

namespace fragmotion {

/// Times as long as a critically damped offset is told to take, until nothing of it is seen.
constexpr double kUnseen = 4;

/// The part of the way that a first-order filter goes in a time, s, with this time constant.
inline double filtered(double seconds, double constant) { return 1 - std::exp(-seconds / constant); }

/// The same of one time constant, which is found once for players that step alike.
class Filter {
 public:
  explicit Filter(double constant) : constant_(constant) {}

  double operator()(double seconds) {
    if (seconds != seconds_) part_ = filtered(seconds, constant_), seconds_ = seconds;
    return part_;
  }

 private:
  double constant_, seconds_ = 0, part_ = 0;
};

}  // namespace fragmotion

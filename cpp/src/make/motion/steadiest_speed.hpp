// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

namespace fragmotion {

/// As near as two speeds are that are the same, of the greater one.
constexpr double kSameSpeed = 0.95;

/// What a point tells of a speed, m/s, and how surely: [windows] each.
struct ToldSpeeds {
  std::vector<double> speeds, weights;
};

/// The speed in each window that changes by `step` at most from one to the next, or by kSameSpeed, and with which most
/// agrees, as surely as it is told: a mode, not a mean, so that what is told otherwise for a short time counts for
/// nothing. `slowest`: what is slower is no speed. Empty where nothing is faster.
std::vector<double> steadiest_speed(const std::vector<ToldSpeeds>& told, double slowest, double step);

}  // namespace fragmotion

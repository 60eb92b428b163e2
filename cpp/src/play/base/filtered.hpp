// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

namespace fragmotion {

/// Times as long as a critically damped offset is told to take, until nothing of it is seen.
constexpr double kUnseen = 4;

/// The part of the way that a first-order filter goes in a time, s, with this time constant.
inline double filtered(double seconds, double constant) { return 1 - std::exp(-seconds / constant); }

}  // namespace fragmotion

// SPDX-License-Identifier: MIT
#pragma once

#include <utility>
#include <vector>

namespace fragmotion {

/// Of what bodies are seen to do: within it is what they do without acrobatics.
constexpr double kUsualShare = 0.99;

/// Under which a share (0 .. 1) of at least one value is: numpy.quantile(values, share), which goes linearly from each
/// value to the next. Takes linear time.
double quantile(std::vector<double> values, double share);

inline double median(std::vector<double> values) { return quantile(std::move(values), 0.5); }

}  // namespace fragmotion

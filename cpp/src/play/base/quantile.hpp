// SPDX-License-Identifier: MIT
#pragma once

#include <utility>
#include <vector>

namespace fragmotion {

/// Under which a share (0 .. 1) of at least one value is: numpy.quantile(values, share), which goes linearly from each
/// value to the next. Takes linear time.
double quantile(std::vector<double> values, double share);

inline double median(std::vector<double> values) { return quantile(std::move(values), 0.5); }

}  // namespace fragmotion

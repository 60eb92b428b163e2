// SPDX-License-Identifier: MIT
#pragma once

namespace fragmotion {

/// Each of `best` [count] becomes row * match + value where that is more.
void max_accumulate(double* best, const double* row, int count, double match, double value);

}  // namespace fragmotion

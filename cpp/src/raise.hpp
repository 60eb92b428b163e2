// SPDX-License-Identifier: MIT
#pragma once

namespace fragmotion {

/// Each of `best` [count] becomes row * match + value where that is more. GCC builds this for AVX2 and without; the
/// bits are the same.
void raise(double* best, const double* row, int count, double match, double value);

}  // namespace fragmotion

// SPDX-License-Identifier: MIT
#pragma once

#include <stdexcept>

namespace fragmotion {

/// Throws std::invalid_argument unless bones are told in such units: nobody does in less than micrometres, or in more
/// than kilometres.
inline void check_unit(double unit) {
  if (!(unit >= 1e-6 && unit <= 1e3)) throw std::invalid_argument("unit: a length from 1e-6 to 1000 metres expected");
}

}  // namespace fragmotion

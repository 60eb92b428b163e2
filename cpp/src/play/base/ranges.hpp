// SPDX-License-Identifier: MIT
#pragma once

#include <sstream>
#include <stdexcept>
#include <string>

namespace fragmotion {

/// The largest coordinate, m, and angle, rad, of a place, at which steps are still told apart.
constexpr double kFarthestPlace = 1e9;

/// s that a step, a call or what plays without one may last.
constexpr double kLongestCall = 3600;

/// s: no trace and no walk lasts longer.
constexpr double kDay = 24 * 3600;

/// A number as short as people write it.
inline std::string text_of(double value) {
  std::ostringstream text;
  text << value;
  return text.str();
}

/// Throws std::invalid_argument "WHAT must be LEAST to MOST, not VALUE" unless it is.
inline void require_range(const char* what, double value, double least, double most) {
  if (value >= least && value <= most) return;
  throw std::invalid_argument(std::string(what) + " must be " + text_of(least) + " to " + text_of(most) + ", not " +
                              text_of(value));
}

}  // namespace fragmotion

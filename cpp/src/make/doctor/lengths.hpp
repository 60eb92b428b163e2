// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdio>
#include <string>

namespace fragmotion {

/// A number with few digits, whatever the locale.
inline std::string short_number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  std::string result = text;
  for (char& c : result) {
    if (c == ',') c = '.';
  }
  return result;
}

inline std::string centimetres(double metres) { return short_number(100 * metres) + " cm"; }

}  // namespace fragmotion

// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

namespace fragmotion {

/// A number with few digits and no exponent, whatever the locale: three that count, or all before the point.
inline std::string short_number(double value) {
  const int before = value == 0 ? 0 : static_cast<int>(std::floor(std::log10(std::abs(value))));
  char text[32];
  std::snprintf(text, sizeof text, "%.*f", std::clamp(2 - before, 0, 9), value);
  std::string result = text;
  std::replace(result.begin(), result.end(), ',', '.');
  if (result.find('.') == std::string::npos) return result;
  result.erase(result.find_last_not_of('0') + 1);
  if (result.back() == '.') result.pop_back();
  return result;
}

/// A length, of a metre and more in metres, else in centimetres.
inline std::string length_text(double metres) {
  return std::abs(metres) < 1 ? short_number(100 * metres) + " cm" : short_number(metres) + " m";
}

}  // namespace fragmotion

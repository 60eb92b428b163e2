// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <vector>

#include "motion/take.hpp"

namespace fragmotion {

/// Ends the program, as libFuzzer expects of what it is to report, where a promise does not hold.
inline void require(bool holds, const char* promise) {
  if (holds) return;
  std::fprintf(stderr, "broken: %s\n", promise);
  std::abort();
}

inline std::string text_of(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

/// Reads an input. A refusal is the one exception that a reader may throw.
template <typename Read>
void read_or_refuse(const Read& read) {
  try {
    read();
  } catch (const std::invalid_argument&) {
  }
}

inline bool all_finite(const std::vector<double>& values) {
  for (const double value : values) {
    if (!std::isfinite(value)) return false;
  }
  return true;
}

inline void check_take(const Take& take, std::size_t file_bytes) {
  const std::size_t poses = static_cast<std::size_t>(take.frames) * take.skeleton.names.size();
  require(take.frames > 0 && take.rate > 0 && std::isfinite(take.rate), "a take has frames and a rate");
  require(take.translations.size() == 3 * poses && take.rotations.size() == 4 * poses, "every bone in every frame");
  require(all_finite(take.translations) && all_finite(take.rotations), "a take is made of numbers");
  require(8 * (take.translations.capacity() + take.rotations.capacity()) <= 50000000 + 20 * file_bytes,
          "a take's memory is in proportion to its file");
}

}  // namespace fragmotion

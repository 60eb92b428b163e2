// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <stdexcept>
#include <string>

namespace fragmotion {

/// A progress callback returned false.
struct Cancelled : std::runtime_error {
  Cancelled() : std::runtime_error("cancelled") {}
};

/// Told now and then, from the calling thread, the fraction done (0..1) and the stage's name; false cancels.
using Progress = std::function<bool(double fraction, const std::string& stage)>;

/// Throws Cancelled where the callback wants it.
inline void report(const Progress& progress, double fraction, const std::string& stage) {
  if (progress && !progress(fraction, stage)) throw Cancelled();
}

/// A part of a task's progress as the whole's.
inline Progress part_of(const Progress& progress, double from, double to) {
  if (!progress) return {};
  return [=](double fraction, const std::string& stage) { return progress(from + (to - from) * fraction, stage); };
}

}  // namespace fragmotion

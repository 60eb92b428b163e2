// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "doctor/patient.hpp"

namespace fragmotion {

/// The runs of frames within another of which `is` is true.
template <typename Is>
std::vector<Run> runs(const Run& within, const Is& is) {
  std::vector<Run> found;
  for (int f = within.begin; f <= within.end; ++f) {
    if (!is(f)) continue;
    if (found.empty() || found.back().end != f - 1) found.push_back({f, f});
    found.back().end = f;
  }
  return found;
}

/// The same of all frames of a take.
template <typename Is>
std::vector<Run> runs(int frames, const Is& is) {
  return runs(Run{0, frames - 1}, is);
}

inline std::string frames_text(const Run& run) {
  return run.length() == 1 ? "frame " + std::to_string(run.begin)
                           : "frames " + std::to_string(run.begin) + " to " + std::to_string(run.end);
}

/// Whether a finding of this code covers the run.
inline bool covers(const Findings& findings, const Run& run) {
  for (const Finding& finding : findings) {
    if (finding.begin <= run.begin && run.end <= finding.end) return true;
  }
  return false;
}

/// The longest time, in frames, over which interpolating invents nothing: 0.12 s, two frames at the least.
inline int brief(double rate) { return std::max(2, static_cast<int>(0.12 * rate)); }

}  // namespace fragmotion

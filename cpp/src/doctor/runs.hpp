// SPDX-License-Identifier: MIT
#pragma once

#include <utility>
#include <vector>

#include "doctor/patient.hpp"

namespace fragmotion {

/// Frames begin to end, the last included.
struct Run {
  int begin = 0, end = 0;

  int length() const { return end - begin + 1; }
  bool operator==(const Run& other) const { return begin == other.begin && end == other.end; }
};

/// The runs of frames of which `is` is true.
template <typename Is>
std::vector<Run> runs(int frames, const Is& is) {
  std::vector<Run> found;
  for (int f = 0; f < frames; ++f) {
    if (!is(f)) continue;
    if (found.empty() || found.back().end != f - 1) found.push_back({f, f});
    found.back().end = f;
  }
  return found;
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

/// Interpolates a bone over a run from the frames beside it; at an end of the take the bone stays as beside it, and
/// where nothing is left it rests.
void bridge(Take& take, int bone, const Run& run);

/// The transform between two frames of all bones, `weight` of the way.
void append_between(const Take& from, int frame, double weight, Take& to);

}  // namespace fragmotion

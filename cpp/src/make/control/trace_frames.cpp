// SPDX-License-Identifier: MIT
#include "control/trace_frames.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "base/rounding.hpp"
#include "control/trace.hpp"

namespace fragmotion {

std::size_t control_at(int frame, double rate, std::size_t controls) {
  const double seconds = std::max(0.0, (frame - 1) / rate);
  return std::min(static_cast<std::size_t>(seconds * kTraceRate + kRounding), controls - 1);
}

int frame_count(std::size_t controls, double rate) {
  if (!(rate > 0 && rate <= 1000)) throw std::invalid_argument("the frame rate must be over 0 and at most 1000");
  const double frames = std::round(static_cast<double>(controls) / kTraceRate * rate);
  if (frames >= kMostFrames) {
    throw std::invalid_argument("a trace of " + std::to_string(controls) + " controls makes " +
                                std::to_string(static_cast<long long>(frames)) + " frames at this rate, at most " +
                                std::to_string(kMostFrames) + " can be played: cut it");
  }
  return static_cast<int>(frames) + 1;
}

}  // namespace fragmotion

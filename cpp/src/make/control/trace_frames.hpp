// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

namespace fragmotion {

/// The most frames that a performance may have: Blender has no more, and they are five hours at 60 a second.
constexpr int kMostFrames = 1048574;

/// The frames of a performance of so many controls: 0 .. round(duration * rate). Throws std::invalid_argument on a rate
/// that is not over 0 and at most 1000, and on more than kMostFrames.
int frame_count(std::size_t controls, double rate);

/// The index of the control that leads to frame `frame` of a performance of a trace of so many controls.
std::size_t control_at(int frame, double rate, std::size_t controls);

}  // namespace fragmotion

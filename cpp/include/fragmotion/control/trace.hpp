// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "fragmotion/control/control.hpp"

namespace fragmotion {

/// Controls a second in a trace.
constexpr double kTraceRate = 10;

/// What a user did with the joystick, a control every 1/kTraceRate s. Controls are kept as they were given, since the
/// points are known only with a character: build() and whatever asks a policy snap() them to its ControlSpace.
/// Player asks for the nearest point, too, but draws fragments by the very control.
using Trace = std::vector<Control>;

/// The indices of the points of the space nearest to a trace's controls.
std::vector<int> snap(const ControlSpace& space, const Trace& trace);

/// Reads a trace from CSV: header velocity_x,velocity_y,turn,jump, a control a row, m/s and flags (turn in [-1,1], jump
/// in [0,1]). Throws std::invalid_argument "FILE:LINE: ..." on a wrong header, number of values, number or range, and
/// on fewer than two rows.
Trace read_trace(const std::filesystem::path& path);

/// Writes a trace as read_trace reads it, shortest numbers that read back the same; through a temporary file, renamed.
void write_trace(const std::filesystem::path& path, const Trace& trace);

}  // namespace fragmotion

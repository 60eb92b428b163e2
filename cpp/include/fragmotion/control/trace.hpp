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
/// 102 points are known only with a character: build() and whatever asks a policy snap() them to its ControlSpace.
/// Player asks for the nearest point, too, but draws fragments by the very control.
using Trace = std::vector<Control>;

/// Reads a trace from CSV: header velocity_x,velocity_y,turn,jump, a control a row, m/s and flags (turn in [-1,1], jump
/// in [0,1]). Throws std::invalid_argument "FILE:LINE: ..." on a wrong header, number of values, number or range, and
/// on fewer than two rows.
Trace read_trace(const std::filesystem::path& path);

/// Writes a trace as read_trace reads it, shortest numbers that read back the same; through a temporary file, renamed.
void write_trace(const std::filesystem::path& path, const Trace& trace);

/// The names that simulate_trace knows: walker, stroller, runner, sprinter, twitcher, jumper, circler, explorer.
const std::vector<std::string>& simulated_players();

/// A trace of a simulated player: a stick with inertia (critically damped spring) that chases targets, held for a
/// random while, drawn from the player's habits; snapped to the points of `space`. Deterministic on every platform.
/// Throws std::invalid_argument on an unknown player (listing the known ones) or fewer than 2 controls.
Trace simulate_trace(const std::string& player, double seconds, std::uint64_t seed, const ControlSpace& space);

}  // namespace fragmotion

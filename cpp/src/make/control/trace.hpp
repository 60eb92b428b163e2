// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "control/control.hpp"

namespace fragmotion {

/// What a user did with the joystick, a control every 1/kTraceRate s. Controls are kept as they were given, since the
/// points are known only with a character: build() and whatever asks a policy snap() them to its ControlSpace.
/// Player asks for the nearest point, too, but draws fragments by the very control.
using Trace = std::vector<Control>;

/// The indices of the points of the space nearest to a trace's controls.
std::vector<int> snap(const ControlSpace& space, const Trace& trace);

/// What a trace file asks for beside its controls, by names.
struct Asked {
  /// Started before a control of the trace, and held for so many.
  struct Move {
    int control;
    std::string name;
    int held;
  };
  /// Gone over to before a control of the trace; before the first: that in which it begins.
  struct Style {
    int control;
    std::string name;
  };
  /// Where it looks from a control on, by Player::look's number and a place in the world, m.
  struct Look {
    int control;
    int look;
    Vector3 place;
  };
  /// What a hand (0 left, 1 right) reaches for from a control on, as Player::reach.
  struct Reach {
    int control;
    int hand;
    double weight;
    bool carried;
    Vector3 place;
  };
  std::vector<Move> moves;     ///< In the order of their controls.
  std::vector<Style> styles;   ///< Likewise, each another than the one before it.
  std::vector<Look> looks;     ///< Likewise.
  std::vector<Reach> reaches;  ///< Likewise, of each hand.
};

/// Reads a trace from CSV: header velocity_x,velocity_y,turn,jump, a control a row, m/s and flags (turn in [-1,1], jump
/// in [0,1]). Further columns may be `style`, `look`, `left_hand` and `right_hand`, and `move` as often as moves are
/// held at the same time (read_asked()). Throws std::invalid_argument "FILE:LINE: ..." on a wrong header, number of
/// values, number or range, and on fewer than two rows.
Trace read_trace(const std::filesystem::path& path);

/// What the same file asks for beside: a move is held in all rows in succession that name it in one column, a style
/// is gone over to where a row names another than the last one named; likewise a look, `captured`, `ahead` or `at X Y
/// Z`, and what a hand reaches for, `free`, `WEIGHT at X Y Z` or, along with the character, `WEIGHT with X Y Z`. Throws
/// as read_trace().
Asked read_asked(const std::filesystem::path& path);

/// Writes a trace as read_trace() and read_asked() read it, shortest numbers that read back the same, and no further
/// column where nothing is asked for beside; through a temporary file, renamed. What is held beyond the end is held to
/// it. Throws std::invalid_argument on what could not be read back.
void write_trace(const std::filesystem::path& path, const Trace& trace, const Asked& asked = {});

}  // namespace fragmotion

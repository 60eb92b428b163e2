// SPDX-License-Identifier: MIT
#pragma once

namespace fragmotion {

/// The most speeds and directions that a control space may have.
constexpr int kMostSpeeds = 4, kMostDirections = 16;

/// Which points a control space has, and how they are numbered. The default is the paper's (Sec. 4, Fig. 4): 102.
/// Velocity 0 stands; the others go at the speeds, the slowest first, in all directions, counter-clockwise from
/// forward. Point i = (velocity turns() + turn + 1) jumps() + jump; of the paper's, 6 velocity + 2 (turn + 1) + jump.
struct ControlLayout {
  int speeds = 2;      ///< 1 .. kMostSpeeds
  int directions = 8;  ///< 4, 8 or kMostDirections
  bool turn = true;    ///< Whether turns can be asked for.
  bool jump = true;    ///< Whether jumps can be asked for.

  constexpr int velocities() const { return 1 + speeds * directions; }
  constexpr int turns() const { return turn ? 3 : 1; }
  constexpr int jumps() const { return jump ? 2 : 1; }
  constexpr int size() const { return velocities() * turns() * jumps(); }

  /// The point of a velocity, a turn -1 (right) .. 1 and a jump or none; those that cannot be asked for are left out.
  constexpr int index(int velocity, int turning, bool jumping) const {
    return (velocity * turns() + (turn ? turning + 1 : 0)) * jumps() + (jump && jumping ? 1 : 0);
  }
  /// And these of a point.
  constexpr int velocity_of(int index) const { return index / (turns() * jumps()); }
  constexpr int turn_of(int index) const { return turn ? index / jumps() % 3 - 1 : 0; }
  constexpr bool is_jump(int index) const { return jump && index % 2 == 1; }
  /// The speed 0 .. speeds - 1 and the direction 0 .. directions - 1 of a velocity that does not stand.
  constexpr int speed_of(int velocity) const { return (velocity - 1) / directions; }
  constexpr int direction_of(int velocity) const { return (velocity - 1) % directions; }
};

constexpr bool operator==(const ControlLayout& a, const ControlLayout& b) {
  return a.speeds == b.speeds && a.directions == b.directions && a.turn == b.turn && a.jump == b.jump;
}
constexpr bool operator!=(const ControlLayout& a, const ControlLayout& b) { return !(a == b); }

/// How many points the paper's space has.
constexpr int kPaperPoints = ControlLayout().size();

/// Throws std::invalid_argument naming the number that no layout may have.
void check(const ControlLayout& layout);

}  // namespace fragmotion

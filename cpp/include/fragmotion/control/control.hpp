// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>

#include "fragmotion/base/types.hpp"

namespace fragmotion {

/// Slower than this a character of 1.8 m stands, m/s.
constexpr double kMoving = 0.3;

/// What the user asks for, or what a fragment visibly does (Sec. 3.2), in the character frame.
struct Control {
  double x = 0;     ///< Velocity to the right, m/s.
  double y = 0;     ///< Velocity forward, m/s.
  double turn = 0;  ///< Turn rate over ControlSpace::turn_rate; +1 is left, counter-clockwise from above.
  double jump = 0;  ///< 1: jumping.

  double speed() const { return std::sqrt(x * x + y * y); }
  /// Whether it asks for a jump, or what it is evident of is in the air as in one: higher than a bouncy run.
  bool jumps() const { return jump > 0.75; }
};

/// Whether what is evident jumps as is wanted, or does not. A bouncy run, which is in the air too, will do for a run.
bool matches_jump(const Control& evident, const Control& wanted);

/// The weights of ControlDis (Eq. 2). Defaults: going 0.5 m/s too fast (at 1.8 m stature) weighs as much as the whole
/// turn rate, and 3/8 of a jump, so that no jump is made to please a velocity. A weight of 0 ignores its part of a
/// control.
struct ControlWeights {
  double velocity = 3;
  double turn = 1.5;
  double jump = 4;
};

/// The 102 points of the control space (Sec. 4, Fig. 4): standing, 8 directions at a walk and at a run; turning right,
/// not, or left; jumping or not. Point i = 6 velocity + 2 (turn + 1) + jump; velocity 0 stands, 1-8 walk, 9-16 run,
/// both counter-clockwise from forward.
class ControlSpace {
 public:
  static constexpr int kDirections = 8;
  static constexpr int kVelocities = 1 + 2 * kDirections, kTurns = 3, kJumps = 2;
  static constexpr int kPoints = kVelocities * kTurns * kJumps;

  /// The point of a velocity 0 .. 16, a turn -1 (right) .. 1, and a jump or none; and these of a point.
  static constexpr int index(int velocity, int turn, bool jump) {
    return (velocity * kTurns + turn + 1) * kJumps + (jump ? 1 : 0);
  }
  static constexpr int velocity_of(int index) { return index / (kTurns * kJumps); }
  static constexpr int turn_of(int index) { return index / kJumps % kTurns - 1; }
  static constexpr bool jumps(int index) { return index % kJumps == 1; }
  /// Whether a velocity is a run; and its direction 0 .. 7 where it does not stand.
  static constexpr bool runs(int velocity) { return velocity > kDirections; }
  static constexpr int direction_of(int velocity) { return (velocity - 1) % kDirections; }

  /// Speeds in m/s with 0 < walk < run, turn rate in rad/s, scale = 1.8 m / stature (distances are those of a character
  /// of 1.8 m). Throws std::invalid_argument naming the value that is out of range.
  explicit ControlSpace(double walk = 1.2, double run = 3.3, double turn_rate = 70 * kPi / 180, double scale = 1,
                        ControlWeights weights = {});

  double walk() const { return walk_; }
  double run() const { return run_; }
  double turn_rate() const { return turn_rate_; }
  double scale() const { return scale_; }
  /// The most that a control's turn is: 1 or, where the takes turn slowly, 170 degrees/s, but no more than 6.
  double quickest_turn() const;
  /// The turn of a control for a character to face where is `off` rad to the left of where it faces, soon and softly.
  double turn_towards(double off) const;
  const ControlWeights& weights() const { return weights_; }
  const Control& point(int index) const { return points_[index]; }

  /// Index of the point nearest to `control` by distance(); the lower index on a tie.
  int nearest(const Control& control) const;
  /// ControlDis (Eq. 2): weighted Euclidean, a weight multiplying its difference before it is squared:
  /// sqrt((velocity scale)^2 (dx^2 + dy^2) + (turn dturn)^2 + (jump djump)^2), turn and jump standing for their
  /// weights.
  double distance(const Control& a, const Control& b) const;

 private:
  double walk_, run_, turn_rate_, scale_;
  ControlWeights weights_;
  std::array<Control, kPoints> points_;
};

}  // namespace fragmotion

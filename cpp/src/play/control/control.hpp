// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <vector>

#include "base/types.hpp"
#include "control/control_layout.hpp"

namespace fragmotion {

/// Controls a second in a trace: players hardly change what they ask for more often.
constexpr double kTraceRate = 10;
/// s from one to the next.
constexpr double kControlStep = 1 / kTraceRate;

/// s: time constant of the last of a turn to where a character is to face.
constexpr double kFacing = 0.25;

/// Turn rates of a space that are asked for at most: what ControlSpace::quickest_turn() is at most.
constexpr double kMostTurn = 6;

/// Of each number of a control that is asked for: nothing is faster than a million m/s, and the squares of such are
/// numbers still.
constexpr double kMostControl = 1e6;

/// Of a space's speeds, m/s, rates, rad/s, scale and weights: squares are numbers still, and characters from a
/// micrometre to a thousand kilometres are within it.
constexpr double kMostOfSpace = 1e9;

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
inline bool matches_jump(const Control& evident, const Control& wanted) {
  constexpr double kLeap = 0.9;  // evident jump of what is no run
  return wanted.jumps() ? evident.jumps() : evident.jump < kLeap;
}

/// The weights of ControlDis (Eq. 2). Defaults: going 0.5 m/s too fast (at 1.8 m stature) weighs as much as the whole
/// turn rate, and 3/8 of a jump, so that no jump is made to please a velocity. A weight of 0 ignores its part of a
/// control.
struct ControlWeights {
  double velocity = 3;
  double turn = 1.5;
  double jump = 4;
};

/// ControlDis between controls that is "a lot" (Sec. 3.3): what was decided on is decided anew.
constexpr double kChange = 1;

/// ControlSpace::distance(), for loops over many: the weight of the velocity squared, those of turn and jump.
struct ControlMetric {
  double velocity_squared, turn, jump;

  double operator()(const Control& a, const Control& b) const {
    const auto square = [](double value) { return value * value; };
    return std::sqrt(velocity_squared * (square(a.x - b.x) + square(a.y - b.y)) + square(turn * (a.turn - b.turn)) +
                     square(jump * (a.jump - b.jump)));
  }
};

/// What can be asked for (Sec. 4): the points of a layout at a character's own speeds and turn rate. The default is the
/// paper's, of 102 points (Fig. 4).
class ControlSpace {
 public:
  /// Speeds in m/s with 0 < walk < run, turn rate in rad/s, scale = 1.8 m / stature (distances are those of a character
  /// of 1.8 m). Throws std::invalid_argument naming the value that is out of range.
  explicit ControlSpace(double walk = 1.2, double run = 3.3, double turn_rate = 70 * kPi / 180, double scale = 1,
                        ControlWeights weights = {});
  /// As many speeds as the layout has, ascending.
  ControlSpace(const ControlLayout& layout, std::vector<double> speeds, double turn_rate, double scale,
               ControlWeights weights = {});

  const ControlLayout& layout() const { return layout_; }
  /// How many points there are.
  int size() const { return static_cast<int>(points_.size()); }
  /// m/s, the slowest first; and what they are called, numbers into kGaits.
  const std::vector<double>& speeds() const { return speeds_; }
  const std::vector<int>& gaits() const { return gaits_; }
  /// The slowest speed, that of the walk or of what comes nearest to one, and the fastest.
  double slowest() const { return speeds_.front(); }
  double walk() const { return walk_; }
  double run() const { return speeds_.back(); }
  double turn_rate() const { return turn_rate_; }
  double scale() const { return scale_; }
  /// The most that a control's turn is: 1 or, where the takes turn slowly, 170 degrees/s, but no more than 6.
  double quickest_turn() const;
  /// The turn of a control for a character to face where is `off` rad to the left of where it faces, soon and softly.
  double turn_towards(double off) const;
  /// What is farther off than this to a side, rad, is behind: nearer to the next direction than to sideways.
  double behind() const { return kPi / 2 + kPi / layout_.directions; }
  const ControlWeights& weights() const { return weights_; }
  const Control& point(int index) const { return points_[index]; }

  /// Whether a control asks to go, by single steps at least: for more than four fifths of kMoving.
  bool asks_to_go(const Control& control) const;
  /// Whether a control is a stand: who stands shifts his weight, but does not turn.
  bool stands(const Control& control) const { return !asks_to_go(control) && !turns(control.turn); }
  /// Whether a turn is nearer to one than to none.
  static bool turns(double turn) { return std::abs(turn) >= 0.5; }

  /// The control without a turn or a jump where none can be asked for.
  Control admitted(const Control& control) const {
    return {control.x, control.y, layout_.turn ? control.turn : 0, layout_.jump ? control.jump : 0};
  }
  /// What controls are told in whole numbers of: thousandths of a metre a second of a 1.8 m character, of the turn rate
  /// and of a jump.
  Control steps() const { return {kStep / scale_, kStep / scale_, kStep, kStep}; }
  /// The nearest control in whole steps().
  Control rounded(const Control& control) const;
  /// Index of the point nearest to `control` by distance(); the lower index on a tie.
  int nearest(const Control& control) const;
  /// ControlDis (Eq. 2): weighted Euclidean, a weight multiplying its difference before it is squared:
  /// sqrt((velocity scale)^2 (dx^2 + dy^2) + (turn dturn)^2 + (jump djump)^2), turn and jump standing for their
  /// weights.
  double distance(const Control& a, const Control& b) const { return metric()(a, b); }
  ControlMetric metric() const {
    const double velocity = weights_.velocity * scale_;
    return {velocity * velocity, weights_.turn, weights_.jump};
  }

 private:
  static constexpr double kStep = 1e-3;

  ControlLayout layout_;
  std::vector<double> speeds_;
  std::vector<int> gaits_;
  double walk_, turn_rate_, scale_;
  ControlWeights weights_;
  std::vector<Control> points_;
};

}  // namespace fragmotion

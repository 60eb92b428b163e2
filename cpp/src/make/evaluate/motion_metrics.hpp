// SPDX-License-Identifier: MIT
#pragma once

#include "evaluate/dragging.hpp"
#include "evaluate/footfalls.hpp"
#include "evaluate/joint_limits.hpp"
#include "evaluate/jumps.hpp"
#include "evaluate/performance.hpp"
#include "evaluate/spread.hpp"

namespace fragmotion {

/// How far something of all joints goes from one frame to the next, at 60 frames a second: 99th and 99.9th percentile
/// and the greatest.
struct Steps {
  double p99 = 0, p999 = 0, worst = 0;
};

/// The means of find_jumps(); NaN where there are none.
struct JumpMeans {
  int count = 0;
  double dip = 0, landing_dip = 0;  ///< m
  double flight_ratio = 0;
};

/// What a viewer finds fault with. Lengths are those of a character of 1.8 m. Feet are judged by ball and heel (heads
/// of toe and foot), whose height is that over where they stand in the takes.
struct MotionMeasures {
  double foot_skate = 0;     ///< Mean horizontal speed of balls and heels, weighted by 2 - 2^(height / 2.5 cm), m/s.
  double sliding_share = 0;  ///< Share of the time with a point under 2.5 cm in which it goes faster than 0.1 m/s.
  double foot_turn = 0;      ///< Mean rate at which feet turn on the ground, weighted by ball and heel likewise, rad/s.
  double penetration = 0;    ///< The deepest that a point sinks under the ground, m.
  Steps positions;           ///< m
  Steps velocities;          ///< m/s
  Steps accelerations;       ///< m/s^2
  Pushes center_of_mass, hips;
  Spread yaw;  ///< rad/s^2: the change over 0.2 s of the mean turn rate over 0.2 s, of facing().
  JumpMeans jumps;
  Footfalls footfalls;
  double dragged_share = 0;  ///< Dragging, of feet along the ground.
  Excess turns;              ///< Beyond what joints do in the takes; of a take, in all others.
};

/// Measures performances by what the takes do themselves.
class MotionMetrics {
 public:
  /// Throws std::invalid_argument on a character that holds no captured fragment.
  explicit MotionMetrics(const Character& character);

  /// The captured takes' own measures.
  const MotionMeasures& takes() const { return takes_; }
  /// A performance's measures; its steps are those within a quarter of a second after a fragment began. Throws
  /// std::invalid_argument on one of another number of bones, or whose parts do not fit together.
  MotionMeasures of(const Performance& performance) const;

 private:
  Skeleton skeleton_;
  Floors floors_;  // m of a 1.8 m character
  UsualHeights usual_;
  FootClearance clearance_;
  JointLimits limits_;
  MotionMeasures takes_;
};

}  // namespace fragmotion

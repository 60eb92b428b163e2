// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "fragmotion/evaluate/joint_limits.hpp"
#include "fragmotion/evaluate/performance.hpp"

namespace fragmotion {

/// How far something of all joints goes from one frame to the next, at 60 frames a second: 99th and 99.9th percentile
/// and the greatest.
struct Steps {
  double p99 = 0, p999 = 0, worst = 0;
};

/// How hard a body is pushed along the ground: the change over 0.2 s of its mean velocity over 0.2 s, m/s^2. A body can
/// push itself by some 5, a sprinter's start is 6, and near 8 a shoe slips.
struct Pushes {
  double p50 = 0, p99 = 0, p999 = 0, worst = 0;
  double over_6 = 0;  ///< Share of the time in which it is more than 6 m/s^2.
};

/// What a viewer finds fault with. Lengths are those of a character of 1.8 m. Feet are judged by ball and heel (heads
/// of toe and foot), whose height is that over where they stand in the takes.
struct MotionMeasures {
  double foot_skate = 0;     ///< Mean horizontal speed of balls and heels, weighted by 2 - 2^(height / 2.5 cm), m/s.
  double sliding_share = 0;  ///< Share of the time with a point under 2.5 cm in which it goes faster than 0.1 m/s.
  double penetration = 0;    ///< The deepest that a point sinks under the ground, m.
  Steps positions;           ///< m
  Steps velocities;          ///< m/s
  Steps accelerations;       ///< m/s^2
  Pushes center_of_mass, hips;
  Excess turns;  ///< Beyond what joints do in the takes; of a take, in all others.
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
  std::array<double, 4> floors_{};  // where left ball, left heel, right ball and right heel stand, m
  JointLimits limits_;
  MotionMeasures takes_;
};

}  // namespace fragmotion

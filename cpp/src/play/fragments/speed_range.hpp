// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "fragments/fragment.hpp"

namespace fragmotion {

/// rad to either side of a direction that count as the same.
constexpr double kSameDirection = kPi / 6;

/// Whether it turns, by 30 degrees/s at least, where turns are counted in this rate.
bool is_turning(const Control& evident, double turn_rate);

/// Whether it goes ahead (kSameDirection) and does not turn.
bool goes_straight_ahead(const Control& evident, double turn_rate);

/// How fast a character goes in each direction at most: 1.3 times as fast as its takes and their mirror images go
/// within 30 degrees of it, and at least as fast as it walks. Who turns goes aside and backward for a moment alone,
/// with what speed is left of another direction: that counts for ahead only.
class SpeedRange {
 public:
  /// Of a character that does nothing but walk.
  explicit SpeedRange(double walk = 0) : walk_(walk) {}
  /// Made fragments count for nothing.
  SpeedRange(const std::vector<Fragment>& fragments, const ControlSpace& space);

  /// The control, as fast as its direction allows.
  Control within(const Control& control) const;

 private:
  double most(const Control& control) const;

  double walk_;
  std::vector<double> most_;  // m/s, of directions around the circle; empty: it walks in all
};

}  // namespace fragmotion

// SPDX-License-Identifier: MIT
#pragma once

#include "base/approach.hpp"
#include "feet/foot_on_ground.hpp"

namespace fragmotion {

/// 1/s: how quickly hips get to the level of the ground.
constexpr double kHipsFollow = 8;

using FeetOnGround = std::array<FootOnGround, 2>;  ///< Left, right.

/// How high hips go: from footing to footing as they get from above the one to above the next, without a kink, and
/// lower where legs would be too short.
class HipsOnGround {
 public:
  /// Goes on to hips over `place`, `seconds` after the last.
  void advance(const Vector2& place, const FeetOnGround& feet, double seconds);
  /// Goes on to hips that are lower than their level: by `now`, m, and by `soon` in `due` seconds; they come up
  /// again in `rising` seconds.
  void sink(double now, double soon, double due, double rising, double seconds);

  /// Of the ground under them, m.
  double level() const { return level_; }
  double sunk() const { return sunk_.value; }

 private:
  friend struct PlayerState;

  bool fresh_ = true;
  Vector2 place_ = Vector2::Zero();
  double level_ = 0, speed_ = 0;  // m and m/s
  Approach sunk_;
};

/// The height of the line from footing to footing at a place, m.
double level_between(const FeetOnGround& feet, const Vector2& place);

}  // namespace fragmotion

// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "control/control.hpp"
#include "direct/path.hpp"

namespace fragmotion {

/// How near to a place a body is there, m of a 1.8 m character: what of a path is shorter does not show.
constexpr double kArrived = 0.2;
/// How near a place is within its reach, m of a 1.8 m character.
constexpr double kReach = 2 * kArrived;
/// How near to a place a body is about there, m of a 1.8 m character.
constexpr double kNearby = 0.5;
/// The slowest that a body goes along a path, of a walk.
constexpr double kSlowest = 0.5;

/// How fast a body can go along a path: no faster than a character runs, slower where the path bends more than it can
/// follow, braking before that, and so that it can stop at the end if it is to stand there. It can
/// RootLimits::acceleration in all: in a bend as much of it sideways as along, which is 1/sqrt(2) of it, and where it
/// runs half of it over time, since its feet are on the ground about half of the time.
class PathPace {
 public:
  /// `by_speeds`: the path's own speeds limit it, too.
  PathPace(const ControlSpace& space, const Path& path, bool stands_at_end, bool by_speeds);

  /// The greatest speed at a place, m/s.
  double limit(double way) const;
  /// How long it takes from a place to the path's end, s, going at `going` m/s now and at `speed` where it can.
  double seconds_left(double way, double going, double speed) const;
  /// How far a body that goes at a speed still goes once it is told to stand, m.
  double stopping_distance(double speed) const { return speed * speed / (2 * acceleration_); }
  /// How fast a body gets slower once it is told to stand, m/s^2.
  double acceleration() const { return acceleration_; }
  /// The speed with which it arrives in so many seconds, from `least` to `most` m/s.
  double speed_to_arrive(double way, double going, double seconds, double least, double most) const;

 private:
  double corner(const Path& path, double way, double run) const;
  void brake();

  double length_, scale_, walk_, step_;
  double acceleration_;  // m/s^2
  bool closed_, stands_;
  std::vector<double> limits_;  // m/s, every step_ m from the beginning to the end
};

}  // namespace fragmotion

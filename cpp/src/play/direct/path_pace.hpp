// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "control/control.hpp"
#include "direct/path.hpp"

namespace fragmotion {

/// How much faster than a character runs its body goes at most along a path, to be there in time.
constexpr double kMostPace = 1.1;

/// How fast a body can go along a path: no faster than a character runs, slower where the path bends more than it can
/// follow, braking before that, and so that it can stop at the end if it is to stand there.
class PathPace {
 public:
  /// `by_speeds`: the path's own speeds limit it, too.
  PathPace(const ControlSpace& space, const Path& path, bool stands_at_end, bool by_speeds);

  /// The greatest speed at a place, m/s.
  double limit(double way) const;
  /// How long it takes from a place to the path's end, s, going at `going` m/s now and at `speed` where it can.
  double seconds_left(double way, double going, double speed) const;
  /// How far a body that goes at a speed still goes once it is told to stand, m.
  double stopping_distance(double speed) const;
  /// The speed with which it arrives in so many seconds, from `least` to `most` m/s.
  double speed_to_arrive(double way, double going, double seconds, double least, double most) const;

 private:
  double corner(const Path& path, double way, double run) const;
  void brake();
  bool leaves_bend(std::size_t i) const;  // whether it goes faster from there on

  double length_, scale_, walk_, step_;
  bool closed_, stands_;
  std::vector<double> limits_;  // m/s, every step_ m from the beginning to the end
};

}  // namespace fragmotion

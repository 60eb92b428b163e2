// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <vector>

#include "control/control.hpp"
#include "fragments/distance.hpp"

namespace fragmotion {

/// How high a character bears its head, hands and hips for most of the time: the medians over what goes straight ahead,
/// or where nothing does, anywhere, at about the speed of its walk, and of its run.
class GaitHeights {
 public:
  /// Of all fragments, of which these are the trajectories, which must outlive it.
  GaitHeights(const Trajectories& t, const std::vector<Fragment>& fragments, const ControlSpace& space);

  /// How much further from them fragments `first` to `last` are on the mean, which go at such a speed, than half of all
  /// that go so: the sum over the tips, m a metre of reach. Much where a body crouches, hops or dances.
  double excess(int first, int last, double speed) const;

  /// What goes so fast: 0 is the walk, 1 the run.
  std::size_t gait_at(double speed) const { return speed < faster_ ? 0 : 1; }

 private:
  const float* heights(int fragment) const {
    return trajectories_->first_pose(fragment) + std::size_t{2} * trajectories_->pose_stride;
  }

  double distance(int first, int last, std::size_t gait) const;

  const Trajectories* trajectories_;
  double faster_;                             // m/s: half way from the walk to the run
  std::array<std::vector<double>, 2> usual_;  // of the walk and of the run [tips]
  std::array<double, 2> distances_{};         // the median from these
};

}  // namespace fragmotion

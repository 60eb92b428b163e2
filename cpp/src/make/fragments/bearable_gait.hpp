// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <tuple>

#include "fragments/fragment.hpp"
#include "fragments/gait_cycle.hpp"
#include "fragments/gait_edit.hpp"
#include "motion/joint_ranges.hpp"

namespace fragmotion {

/// How the gaits of a pool may be changed for their joints to bear it.
class BearableGaits {
 public:
  /// Of the clips that there are now. Clip c is of take c % `takes`: mirror images come after the takes, in their
  /// order.
  BearableGaits(const Kinematics& kinematics, const Legs& legs, const FragmentPool& pool, std::size_t takes);

  /// The edit of the cycle that goes from a frame to another of a clip, as far as its joints bear it. Where the thighs
  /// or knees would leave their ranges, the hips of a body on two legs turn towards the path as far as is needed and
  /// the spine bears; where that is too little, the path is slower. A range is left no further than a take leaves that
  /// of the others, in the mean, and than in the cycle itself, or as it steps in place or straight on. Whether it
  /// turns makes no difference.
  GaitEdit operator()(int clip, int begin, int end, GaitEdit edit);

 private:
  GaitEdit find(const Clip& clip, int begin, int end, GaitEdit edit) const;
  double most_turn(const GaitCycle& cycle, double wanted) const;

  const Kinematics& kinematics_;
  const Legs& legs_;
  const FragmentPool& pool_;
  JointRanges leg_ranges_, spine_ranges_;
  std::map<std::tuple<int, int, int, double, double>, GaitEdit> found_;  // by cycle, direction and speed
};

}  // namespace fragmotion

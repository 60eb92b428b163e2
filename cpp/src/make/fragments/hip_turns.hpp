// SPDX-License-Identifier: MIT
#pragma once

#include <tuple>

#include "base/memo.hpp"
#include "fragments/fragment.hpp"
#include "fragments/gait_cycle.hpp"
#include "fragments/gait_edit.hpp"
#include "motion/joint_ranges.hpp"

namespace fragmotion {

/// How hips turn in gaits of a pool whose path is changed, for the legs' joints to bear it.
class HipTurns {
 public:
  /// Of the clips that there are now. Clip c is of take c % `takes`: mirror images come after the takes, in their
  /// order.
  HipTurns(const Kinematics& kinematics, const Legs& legs, const FragmentPool& pool, std::size_t takes);

  /// How far the hips are to be turned, rad, in an edit of the cycle that goes from a frame to another of a clip, of
  /// which `number` tells it from others. Where the thighs or knees would leave their ranges, those of a body on two
  /// legs turn towards the path as far as is needed, or as the spine bears. A range is left no further than a take
  /// leaves that of the others, in the mean, and than in the cycle itself, or as it steps in place or straight on.
  /// Whether it turns makes no difference. Threads may ask at the same time.
  double of(const Clip& clip, int number, int begin, int end, GaitEdit edit);

 private:
  double find(const Clip& clip, int begin, int end, const GaitEdit& edit) const;
  double most_turn(const GaitCycle& cycle, double wanted) const;

  const Kinematics& kinematics_;
  const Legs& legs_;
  const FragmentPool& pool_;
  JointRanges leg_ranges_, spine_ranges_;
  Memo<std::tuple<int, int, int, double, double, double>, double> found_;  // by cycle, direction, speed and tempo
};

}  // namespace fragmotion

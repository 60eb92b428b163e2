// SPDX-License-Identifier: MIT
#pragma once

#include <tuple>

#include "base/memo.hpp"
#include "fragments/fragment.hpp"
#include "fragments/gait_cycle.hpp"
#include "fragments/gait_edit.hpp"
#include "motion/joint_ranges.hpp"

namespace fragmotion {

/// What is done in gaits of a pool whose path is changed for the legs' joints to bear it.
class BorneGaits {
 public:
  /// Of the clips that there are now. Steps are hurried at most so many times.
  BorneGaits(const Kinematics& kinematics, const Legs& legs, const FragmentPool& pool, double most_hurry,
             int threads = 1);

  /// An edit of the cycle that goes from a frame to another of a clip, of which `number` tells it from others. Where
  /// the thighs or knees would leave their ranges further than in the cycle itself, or as it steps in place or straight
  /// on, the hips of a body on two legs turn towards the path as far as is needed, helps, and the spine bears; and
  /// where that is not enough, its steps are hurried, likewise, and shorter. Whether it turns makes no difference.
  /// Threads may ask at the same time.
  GaitEdit of(const Clip& clip, int number, int begin, int end, const GaitEdit& edit);

 private:
  struct Change {
    double hips = 0, hurry = 1;  // rad; times
  };

  Change find(const Clip& clip, int begin, int end, const GaitEdit& edit) const;
  double most_turn(const GaitCycle& cycle, double wanted) const;

  const Kinematics& kinematics_;
  const Legs& legs_;
  const FragmentPool& pool_;
  double most_hurry_;
  JointRanges leg_ranges_, spine_ranges_;
  Memo<std::tuple<int, int, int, double, double, double>, Change> found_;  // by cycle, direction, speed and tempo
};

}  // namespace fragmotion

// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "fragments/fragment.hpp"
#include "motion/joint_ranges.hpp"

namespace fragmotion {

/// How far joints turn beyond what was seen of them: the share of all joints in all frames that do so by more than a
/// degree, and the furthest, rad.
struct Excess {
  double share = 0, worst = 0;
};

/// The ranges of the joints, which are the measured_bones() below the hips, in the takes and their mirror images.
class JointLimits {
 public:
  explicit JointLimits(const PackedPool& pool);

  /// The fair figure for the takes themselves: each beyond the range of all others. Nothing where there is one only.
  const Excess& takes() const { return takes_; }

  /// A motion's: rotations [frames, bones, 4] as in Clip. Throws std::invalid_argument on another number of bones.
  Excess of(const std::vector<double>& rotations) const;

 private:
  std::size_t width_;  // numbers of a pose
  std::vector<JointAxes> joints_;
  TurnRanges ranges_;
  Excess takes_;
};

}  // namespace fragmotion

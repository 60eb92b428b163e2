// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "fragments/fragment.hpp"
#include "fragments/tip_rows.hpp"

namespace fragmotion {

/// Poses of a trajectory.
constexpr int kPoses = 16;

/// The fragments as points of the space in which Dis is a norm. Lengths are those of a character of 1.8 m.
/// A trajectory is `poses` poses at equal times, all in the character frame of the first; `first` and `last` are the
/// poses with which the fragment's playing begins and ends, each in its own character frame.
struct Trajectories {
  int count = 0;
  int tips = 0;      ///< Points of each pose, one behind another in a row; 0 where there is but one pose.
  double reach = 0;  ///< tip_reach() of the skeleton; as tips.
  TipRows whole;
  int pose_stride = 0;       ///< Floats in a row of an end pose.
  std::vector<float> first;  ///< [count, 3, pose_stride]
  std::vector<float> last;   ///< [count, 3, pose_stride]

  const float* first_pose(int i) const { return &first[static_cast<std::size_t>(i) * 3 * pose_stride]; }
  const float* last_pose(int i) const { return &last[static_cast<std::size_t>(i) * 3 * pose_stride]; }
};

/// The most poses of a trajectory: half a second sampled as often as any camera does it holds no more.
constexpr int kMostPoses = 1000;

/// Samples every fragment of the pool, packed or not, at `poses` times; but for the first ones, of which as many are
/// `known`, sampled so, and of which not more is seen anew than with which poses their playing begins and ends. Throws
/// std::invalid_argument unless the times are 2 to kMostPoses.
template <typename AnyClip>
Trajectories trajectories(const Pool<AnyClip>& pool, int poses = kPoses, int threads = 0, Trajectories known = {});

/// Dis(f, g) of two fragments: summed over corresponding poses.
float fragment_distance(const Trajectories& t, int f, int g);

/// Dis(p_m of f, p_1 of g) (Eq. 2).
float transition_distance(const Trajectories& t, int f, int g);

}  // namespace fragmotion

// SPDX-License-Identifier: MIT
#pragma once

#include "small_skeleton.hpp"
#include "walker.hpp"

namespace fragmotion {

/// The humanoid with bone frames turned at random: what bones' axes a rig has must not matter.
inline Skeleton rolled_humanoid(std::uint64_t seed) {
  const Skeleton straight = humanoid();
  Skeleton skeleton = straight;
  Random random(seed);
  std::vector<Quaternion> turn;
  for (int b = 0; b < skeleton.size(); ++b) turn.push_back(random_rotation(random));
  for (int b = 0; b < skeleton.size(); ++b) {
    const int parent = skeleton.parents[b];
    skeleton.rest_rotations[b] = parent < 0 ? turn[b] : turn[parent].conjugate() * turn[b];
    if (parent >= 0) skeleton.offsets[b] = turn[parent].conjugate() * straight.offsets[b];
    skeleton.tips[b] = turn[b].conjugate() * straight.tips[b];
  }
  return make_skeleton(skeleton);
}

}  // namespace fragmotion

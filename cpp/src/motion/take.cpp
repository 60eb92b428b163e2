// SPDX-License-Identifier: MIT
#include "fragmotion/motion/take.hpp"

#include <cstddef>

namespace fragmotion {

void world_transforms(const Take& take, std::vector<double>& positions, std::vector<double>& rotations) {
  const Skeleton& skeleton = take.skeleton;
  const std::size_t bones = skeleton.names.size();
  positions.resize(take.frames * bones * 3);
  rotations.resize(take.frames * bones * 4);
  for (std::size_t frame = 0; frame < static_cast<std::size_t>(take.frames); ++frame) {
    for (std::size_t bone = 0; bone < bones; ++bone) {
      const std::size_t at = frame * bones + bone;
      Vector3 position = load_vector(&take.translations[at * 3]);
      Quaternion rotation = load_quaternion(&take.rotations[at * 4]);
      if (bone > 0) {
        const std::size_t parent = frame * bones + skeleton.parents[bone];
        const Quaternion parent_rotation = load_quaternion(&rotations[parent * 4]);
        position = load_vector(&positions[parent * 3]) + parent_rotation * position;
        // Renormalised so that long chains do not drift from unit length.
        rotation = (parent_rotation * rotation).normalized();
      }
      store_vector(position, &positions[at * 3]);
      store_quaternion(rotation, &rotations[at * 4]);
    }
  }
}

}  // namespace fragmotion

// SPDX-License-Identifier: MIT
#include "clips.hpp"

#include <cstddef>
#include <stdexcept>

namespace fragmotion::bindings {

void check_bones(const Clip& clip, const Skeleton& skeleton) {
  if (clip.rotations.size() == std::size_t{4} * skeleton.size() * clip.frames) return;
  throw std::invalid_argument("clip \"" + clip.name + "\" has not the skeleton's number of bones");
}

void check_bones(const std::vector<Clip>& clips, const Skeleton& skeleton) {
  for (const Clip& clip : clips) check_bones(clip, skeleton);
}

}  // namespace fragmotion::bindings

// SPDX-License-Identifier: MIT
#pragma once

#include "base/turn_between.hpp"
#include "walker.hpp"

namespace fragmotion {

/// A humanoid()'s clip as a studio captures it whose floor rises by `slope` along x and y.
inline Clip on_slope(const Vector2& slope, Clip clip) {
  const Quaternion turn = turn_between(Vector3::UnitZ(), {-slope.x(), -slope.y(), 1});
  const int bones = humanoid().size();
  for (int f = 0; f < clip.frames; ++f) {
    double *place = &clip.root_positions[std::size_t{3} * f], *hips = &clip.rotations[std::size_t{4} * bones * f];
    store_vector(turn * load_vector(place), place);
    store_quaternion(turn * load_quaternion(hips), hips);
  }
  return clip;
}

}  // namespace fragmotion

// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "base/random.hpp"
#include "motion/clip.hpp"
#include "motion/take.hpp"
#include "skeleton/roles.hpp"

namespace fragmotion {

inline Quaternion random_rotation(Random& random) {
  Quaternion q;
  do {
    for (int i = 0; i < 4; ++i) q.coeffs()[i] = 2 * random.uniform() - 1;
  } while (q.norm() < 0.1);
  return q.normalized();
}

inline Vector3 random_vector(Random& random, double size = 1) {
  return size * Vector3{2 * random.uniform() - 1, 2 * random.uniform() - 1, 2 * random.uniform() - 1};
}

/// root > {prop, hips > {thigh.L > foot.L, thigh.R > foot.R, spine}}; rest frames are the world's axes, the character
/// faces -y, so that its left is at +x.
inline Skeleton small_skeleton() {
  Skeleton skeleton;
  skeleton.names = {"root", "prop", "hips", "thigh.L", "foot.L", "thigh.R", "foot.R", "spine"};
  skeleton.parents = {-1, 0, 0, 2, 3, 2, 5, 2};
  skeleton.rest_rotations.assign(8, Quaternion::Identity());
  skeleton.offsets = {{0, 0, 0},       {1, 2, 0.5},      {0, 0, 1},       {0.1, 0, -0.05},
                      {0, 0.02, -0.4}, {-0.1, 0, -0.05}, {0, 0.02, -0.4}, {0, 0, 0.2}};
  skeleton.tips = {{0, 0, 0.3},  {0, 0, 0.2},  {0, 0, 0.2},  {0, 0, -0.4},
                   {0, -0.2, 0}, {0, 0, -0.4}, {0, -0.2, 0}, {0, 0, 0.3}};
  return make_skeleton(skeleton);
}

/// A random motion of every bone: rotations, and translations near the offsets.
inline Take random_take(const Skeleton& skeleton, int frames, std::uint64_t seed, double wander = 0.1) {
  Random random(seed);
  Take take{skeleton, "take", 60, frames, {}, {}};
  for (int f = 0; f < frames; ++f) {
    for (int b = 0; b < skeleton.size(); ++b) {
      const Vector3 place = skeleton.offsets[b] + random_vector(random, wander);
      const Quaternion q = random_rotation(random);
      take.translations.insert(take.translations.end(), place.data(), place.data() + 3);
      take.rotations.insert(take.rotations.end(), {q.w(), q.x(), q.y(), q.z()});
    }
  }
  return take;
}

/// A random clip with unit quaternions, not yet through make_clip.
inline Clip random_clip(const Skeleton& skeleton, int frames, std::uint64_t seed) {
  const Take take = random_take(skeleton, frames, seed);
  Clip clip{"clip", 60, frames, {}, take.rotations, {}};
  Random random(seed + 1);
  for (int i = 0; i < 3 * frames; ++i) clip.root_positions.push_back(4 * random.uniform() - 2);
  return clip;
}

}  // namespace fragmotion

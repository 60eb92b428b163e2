// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <utility>

#include "motion/clip.hpp"
#include "skeleton/roles.hpp"

namespace fragmotion {

/// A body whose legs are one bone each, as Kenney's figures have them, 0.9 m long; it faces -y.
inline Skeleton stilts() {
  Skeleton s;
  s.names = {"root", "torso", "leg-left", "leg-right"};
  s.parents = {-1, 0, 0, 0};
  s.rest_rotations.assign(4, Quaternion::Identity());
  s.offsets = {{0, 0, 0.9}, {0, 0, 0.1}, {0.15, 0, 0}, {-0.15, 0, 0}};
  s.tips = {{0, 0, 0.1}, {0, 0, 0.6}, {0, 0, -0.9}, {0, 0, -0.9}};
  return make_skeleton(std::move(s));
}

/// They walk on the spot: legs swing by 0.6 rad to either side, once in 0.7 s, and the body rises where they are apart,
/// by `hop` m more than keeps them on the ground.
inline Clip stilts_on_the_spot(double hop, double rate = 30, double seconds = 2.1) {
  const Skeleton skeleton = stilts();
  Clip clip;
  clip.name = "stilts", clip.rate = rate, clip.frames = static_cast<int>(std::lround(seconds * rate)) + 1;
  for (int f = 0; f < clip.frames; ++f) {
    const double swing = 0.6 * std::sin(2 * kPi * f / rate / 0.7);
    clip.root_positions.insert(clip.root_positions.end(), {0, 0, 0.9 * std::cos(swing) + hop * std::abs(swing) / 0.6});
    for (const double turn : {0.0, 0.0, swing, -swing}) {
      const double half = turn / 2;
      clip.rotations.insert(clip.rotations.end(), {std::cos(half), std::sin(half), 0, 0});
    }
  }
  return make_clip(skeleton, std::move(clip));
}

/// m/s: how fast their feet go back under the body where they pass each other, and in the mean from end to end.
constexpr double kStiltsPass = 0.9 * 0.6 * 2 * kPi / 0.7;
const double kStiltsGo = 2 * 0.9 * std::sin(0.6) / 0.35;

}  // namespace fragmotion

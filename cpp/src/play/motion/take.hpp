// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "skeleton/skeleton.hpp"

namespace fragmotion {

/// A motion capture file as it stands: every bone's local transform in every frame, metres, z up.
/// A bone's frame in its parent's is the rotation `rotations` at the place `translations` (which replaces
/// `Skeleton::offsets`); bone 0 is relative to the world.
struct Take {
  Skeleton skeleton;
  std::string name;  ///< The file's name without its ending.
  double rate = 0;   ///< Frames a second.
  int frames = 0;
  std::vector<double> translations;  ///< [frames, bones, 3] m
  std::vector<double> rotations;     ///< [frames, bones, 4] unit quaternions (w, x, y, z)
  double unit = 1;                   ///< m: what was taken for one unit of the file's lengths.
};

/// Checks shapes, rate and unit of a take that no reader has made, and makes its rotations unit; numbers may be missing
/// (not finite), and a rotation of length 0 is. Throws std::invalid_argument naming the take.
Take make_take(Take take);

/// World position [frames, bones, 3] and rotation [frames, bones, 4] of every bone's frame.
void world_transforms(const Take& take, std::vector<double>& positions, std::vector<double>& rotations);

/// The same of one pose; all arrays [bones, 3] and [bones, 4].
void world_transforms(const Skeleton& skeleton, const double* local_positions, const double* local_rotations,
                      double* positions, double* rotations);

}  // namespace fragmotion

// SPDX-License-Identifier: MIT
#pragma once

#include "motion/clip.hpp"

namespace fragmotion {

/// A pose in the world: the hips' place, where the character faces (rad), and rotations [bones, 4] as in Clip.
struct WorldPose {
  Vector3 root = Vector3::Zero();
  double heading = 0;
  std::vector<double> rotations;
};

/// The pose that comes as long after one as another was before it, if it goes on so. Allocates nothing where `later`
/// has as many rotations.
void extrapolate(const WorldPose& before, const WorldPose& now, WorldPose& later);

/// Rotations a and b [bones, 4] interpolated on the shorter arc: out = slerp(a, b, weight). `out` may be a or b.
void blend_rotations(const double* a, const double* b, double weight, int bones, double* out);

/// Adds a rotation to a sum of rotations, each w, x, y, z, on the side of the sum: normalised, the sum is their mean.
void add_rotation(const double* rotation, double* sum);

/// The clip's pose at frame `at` (fractional; held at the clip's ends): writes rotations [bones, 4], returns the root
/// position, m.
Vector3 sample_pose(const Clip& clip, double at, double* rotations);

/// The character frame of a clip at frame `at` (fractional; held at the clip's ends): under the hips, facing as
/// `headings`.
CharacterFrame frame_at(const Clip& clip, double at);

/// Ease-in-ease-out weight of the stitching (Fig. 3): 0 at 0, 1 at 1, flat at both.
inline double ease_in_ease_out(double t) { return t <= 0 ? 0 : t >= 1 ? 1 : t * t * (3 - 2 * t); }

}  // namespace fragmotion

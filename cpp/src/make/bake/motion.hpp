// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "motion/pose.hpp"

namespace fragmotion {

/// What was shown, a pose a frame, as Performance has it.
struct Motion {
  double rate = 0;                     ///< Frames a second.
  std::vector<double> root_positions;  ///< [frames, 3] m
  std::vector<double> rotations;       ///< [frames, bones, 4] as in Clip
  std::vector<double> path;            ///< [frames, 3]: character frame x, y in m and heading in rad, unwrapped

  int frames() const { return static_cast<int>(path.size() / 3); }
  int bones() const { return static_cast<int>(rotations.size() / 4) / frames(); }
  CharacterFrame frame(int f) const {
    const double* at = &path[std::size_t{3} * f];
    return {{at[0], at[1]}, at[2]};
  }
};

/// Throws std::invalid_argument, which begins with `name`, unless it has the skeleton's bones, a frame at least, a rate
/// of over 0 to 1000, finite numbers, places within 1e9 m, and unit quaternions.
void check_motion(const Skeleton& skeleton, const Motion& motion, const char* name);

/// A frame of it. `at` must be 0 .. frames - 1.
WorldPose pose_at(const Motion& motion, int at);

/// Replaces frame `at` by a pose and the place of its character frame, which faces as the pose.
void set_pose(Motion& motion, int at, const WorldPose& pose, const Vector2& place);

/// Where `place` is once the character frame `from` is at `to`.
Vector2 carried(const CharacterFrame& from, const CharacterFrame& to, const Vector2& place);

/// The pose once its character frame `from` is at `to`. `hips` is a number of a bone.
void carry(int hips, const CharacterFrame& from, const CharacterFrame& to, WorldPose& pose);

/// The same poses, seen from the character frame, with that frame at `path` [frames, 3].
Motion carried(const Motion& motion, int hips, const std::vector<double>& path);

}  // namespace fragmotion

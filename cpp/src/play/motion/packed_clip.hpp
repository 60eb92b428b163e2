// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "base/simd.hpp"
#include "motion/clip.hpp"

namespace fragmotion {

/// What the packed clips of one skeleton share. A bone's rotation is kept as the turn from its usual one, as axis *
/// tan(angle / 4) in whole steps. The steps are as wide as keeps every bone's rotation, in its parent and in the world,
/// within 0.09 degrees, and every bone's tip within 0.9 mm, of a character of 1.8 m.
struct PoseGrid {
  int bones = 0;
  std::vector<float> usual;  ///< [blocks, 4, kBoneBlock]: unit quaternions; of what no bone is: no rotation
  std::vector<float> steps;  ///< [blocks, kBoneBlock]

  int blocks() const { return (bones + kBoneBlock - 1) / kBoneBlock; }
};

/// The grid for these clips' poses.
PoseGrid pose_grid(const Skeleton& skeleton, const std::vector<Clip>& clips);

/// A clip in about a fifth of its size in single precision. Every pose is to be had by itself.
struct PackedClip {
  std::string name;
  double rate = 0;  ///< Frames a second.
  int frames = 0;
  std::shared_ptr<const PoseGrid> grid;
  std::array<double, 4> origin{}, steps{};  ///< The hips' place in m and the heading in rad: origin + number * step.
  std::vector<std::int32_t> least;          ///< [blocks, 3, kBoneBlock]: a turn is least + number steps
  std::vector<std::uint8_t> bits;           ///< Of each number of a pose: place and heading, then as in `least`.
  std::vector<std::uint8_t> poses;          ///< [frames, pose_bytes] numbers, lowest bits first, and kSpare bytes

  static constexpr int kMostBits = 24;      ///< Of a number.
  static constexpr std::size_t kSpare = 4;  ///< Bytes that may be read beyond the last pose.

  std::size_t pose_bytes() const { return (poses.size() - kSpare) / frames; }
};

/// Keeps a clip; the error of turns does not add up from bone to bone.
PackedClip pack(const Skeleton& skeleton, std::shared_ptr<const PoseGrid> grid, const Clip& clip);

/// All poses of a packed clip.
Clip unpack(const PackedClip& clip);

/// Throws std::invalid_argument unless the parts of a packed clip fit together, so that all its poses can be had and
/// are finite numbers.
void check(const PackedClip& clip, const Skeleton& skeleton);

/// As those of Clip (pose.hpp), but that between frames rotations go straight and are made unit again.
Vector3 sample_pose(const PackedClip& clip, double at, double* rotations);
CharacterFrame frame_at(const PackedClip& clip, double at);

}  // namespace fragmotion

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

/// How the mirror image of a packed pose follows from what the pose is packed in: the turn of bone b from its usual
/// rotation, after before[b] and before after[b], is the image's rotation of bone counterparts[b].
struct PoseMirror {
  std::vector<int> counterparts;     ///< [bones], each the other's; empty: no clip is the image of another
  std::vector<float> before, after;  ///< [blocks, 4, kBoneBlock]: unit quaternions

  bool empty() const { return counterparts.empty(); }
};

/// What the packed clips of one skeleton share. A bone's rotation is kept as the turn from its usual one, as axis *
/// tan(angle / 4) in whole steps.
struct PoseGrid {
  int bones = 0;
  std::vector<float> usual;  ///< [blocks, 4, kBoneBlock]: unit quaternions; of what no bone is: no rotation
  std::vector<float> steps;  ///< [blocks, kBoneBlock]
  PoseMirror mirror;

  int blocks() const { return (bones + kBoneBlock - 1) / kBoneBlock; }
};

/// Where the number of a bone is in [blocks, axes, kBoneBlock].
constexpr std::size_t place_of(int bone, int axis, int axes) {
  return static_cast<std::size_t>(bone / kBoneBlock * axes + axis) * kBoneBlock + bone % kBoneBlock;
}

/// The quaternion of a bone in [blocks, 4, kBoneBlock].
Quaternion quaternion_of(const std::vector<float>& lanes, int bone);

/// The poses of a clip, each to be had by itself.
struct PackedPoses {
  std::array<double, 4> origin{}, steps{};  ///< The hips' place in m and the heading in rad: origin + number * step.
  std::vector<std::int32_t> least;          ///< [blocks, 3, kBoneBlock]: a turn is least + number steps
  std::vector<std::uint8_t> bits;           ///< Of each number of a pose: place and heading, then as in `least`.
  std::vector<std::uint8_t> bytes;          ///< [frames, a pose's] numbers, lowest bits first, and kSpare bytes

  static constexpr int kRootNumbers = 4;    ///< Place and heading.
  static constexpr int kMostBits = 24;      ///< Of a number.
  static constexpr std::size_t kSpare = 4;  ///< Bytes that may be read beyond the last pose.

  std::size_t pose_bytes = 0;  ///< Of each pose: bytes_for() its bits.
};

/// Bytes that numbers of so many bits take.
std::size_t bytes_for(const std::vector<std::uint8_t>& bits);

/// A clip in about a sixth of its size in single precision, and nothing beside the original where it is the mirror
/// image of another.
struct PackedClip {
  std::string name;
  double rate = 0;  ///< Frames a second.
  int frames = 0;
  std::shared_ptr<const PoseGrid> grid;
  std::shared_ptr<const PackedPoses> poses;
  std::vector<Marker> markers = {};
  bool mirrored = false;  ///< The poses are the original's, and this clip shows their mirror image in x = 0.

  /// The number of a bone in the clip's own order, in which its poses are computed: that of the bone whose image it is.
  int lane_of(int bone) const { return mirrored && bone >= 0 ? grid->mirror.counterparts[bone] : bone; }
};

/// The mirror image of a packed clip, in a grid that has a mirror, of which it shares the poses.
PackedClip mirror_image(const PackedClip& original, std::string name);

/// The number of the clip that shares its poses with a mirrored one; -1 of one that is not mirrored, or has none.
int original_of(const std::vector<PackedClip>& clips, std::size_t mirrored);

/// All poses of a packed clip.
Clip unpack(const PackedClip& clip);

/// Throws std::invalid_argument unless the parts of a packed clip fit together, so that all its poses can be had and
/// are finite numbers; of its grid, which clips share, the other one tells.
void check(const PackedClip& clip);
void check(const PoseGrid& grid, const Skeleton& skeleton);

/// As those of Clip (pose.hpp), but that between frames rotations go straight and are made unit again.
Vector3 sample_pose(const PackedClip& clip, double at, double* rotations);
/// The hips' place, m, and where the character faces, rad.
struct RootPose {
  Vector3 place;
  double heading;

  CharacterFrame frame() const { return {place.head<2>(), heading}; }
};

/// That of sample_pose().
RootPose root_at(const PackedClip& clip, double at);
/// Both, but of rotations no more than those of the first `bones` bones need be written.
RootPose sample_pose(const PackedClip& clip, double at, int bones, double* rotations);
inline CharacterFrame frame_at(const PackedClip& clip, double at) { return root_at(clip, at).frame(); }

/// The rotations of a block of bones from their usual ones.
struct TurnBlock {
  float w[kBoneBlock], x[kBoneBlock], y[kBoneBlock], z[kBoneBlock];
};

/// Turns of bones that fade: `offset` times a turn and `speed` times its change, each as modified Rodrigues parameters.
struct FadingTurns {
  /// Of kBoneBlock bones in the clip's own order, or of those that are left, x, y and z of the turn and then of its
  /// change, and kBoneBlock - 1 numbers more, which may be read; null: none.
  const float* lanes = nullptr;
  float offset = 0, speed = 0;
};

/// How a pose is turned further: the hips, if any, in the world, by twice an angle, and then all bones.
struct PoseTurns {
  int hips = -1;
  PlaneTurn half{1, 0};
  FadingTurns fading = {};
};

/// The poses that were unpacked last of clips of one skeleton, since what plays asks for the same ones again and again.
/// Allocates nothing once it is made.
class UnpackedPoses {
 public:
  explicit UnpackedPoses(int bones);

  /// sample_pose() and root_at() to the bit, but that rotations are turned further. The clip's poses must outlive this.
  RootPose sample(const PackedClip& clip, double at, const PoseTurns& further, double* rotations);
  /// Writes the rotation of a bone into [bones, 4], as it was sampled last, of this clip, but without what fades.
  void plain(const PackedClip& clip, int bone, double* rotations) const {
    const int lane = clip.lane_of(bone), i = lane % kBoneBlock;
    const TurnBlock& block = plain_[lane / kBoneBlock];
    store_quaternion({block.w[i], block.x[i], block.y[i], block.z[i]}, rotations + std::ptrdiff_t{4} * bone);
  }

 private:
  int blocks_;
  std::array<const std::uint8_t*, 16> packed_{};  // those of half a second, which come to places by their frames
  std::vector<TurnBlock> turns_;                  // [poses, blocks]
  std::vector<TurnBlock> plain_;
};

}  // namespace fragmotion

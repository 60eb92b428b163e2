// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <vector>

#include "skeleton/two_bone_ik.hpp"

namespace fragmotion {

/// Bone tips as Dis sees them: x, y and z each in a row of floats, padded with zeros to whole blocks of kLanes.
constexpr int kLanes = 8;

/// What Dis grows with from rig to rig: the length of the bones from the hips to each of its tips, summed, m of a
/// character of 1.8 m. A tip moves the more the further out it is, so that the number of tips does not do where limbs
/// are divided otherwise. Thresholds on Dis are told for one metre of it, to mean the same on any rig.
double tip_reach(const Skeleton& skeleton);

/// That of Bandai-Namco's skeleton of 21 tips, on which the thresholds were found.
constexpr double kTunedReach = 17.4;

/// The floats in a row of so many points.
constexpr int padded(int points) { return (points + kLanes - 1) / kLanes * kLanes; }

/// Sum over points of the Euclidean distance between two such vectors of `stride` floats a row (Sec. 3.1): a norm of
/// their difference. The same bits on every x86-64, with AVX2 or without.
float tip_distance(const float* a, const float* b, int stride);

/// The bone tips of poses, as Dis sees them. Allocates nothing once it is made.
class BodyTips {
 public:
  explicit BodyTips(const Skeleton& skeleton);

  int points() const { return static_cast<int>(bones_.size()); }
  /// tip_reach() of the skeleton.
  double reach() const { return reach_; }
  /// Takes a pose: the hips' place and rotations [bones, 4] as in Clip.
  void pose(const Vector3& root, const double* rotations);
  /// Writes its tips as seen from `frame`, as points offset .. of three rows of `stride` floats.
  void write(const CharacterFrame& frame, float* rows, int stride, int offset) const {
    write(frame.position, PlaneTurn(frame.heading), rows, stride, offset);
  }
  /// The same of a frame at a place, and facing like that.
  void write(const Vector2& place, const PlaneTurn& facing, float* rows, int stride, int offset) const;

 private:
  Kinematics kinematics_;
  std::vector<int> bones_;
  double scale_, reach_;
  std::vector<int> chains_;  // the bones_ and those between them and the hips
  std::vector<int> joined_;  // of each of the bones_, the one of chains_ whose head is its tip; -1 where there is none
  PosedBones posed_;
  std::vector<Vector3> tips_;  // of the bones_, in the world
};

/// Writes the bone tips of many poses to the bit as BodyTips does, and poses several at once, by vector instructions.
/// Allocates nothing once it is made.
class TipWriter {
 public:
  explicit TipWriter(const Skeleton& skeleton);

  int points() const { return static_cast<int>(measured_.size()); }
  /// Where the rotations [bones, 4] of the pose that is added next are put.
  double* rotations() { return rotations_[count_].data(); }
  /// Adds the pose with these and with its hips there: its tips as seen from `frame` are written as points offset .. of
  /// three rows of `stride` floats, at the latest by flush().
  void add(const Vector3& root, const CharacterFrame& frame, float* rows, int stride, int offset);
  void flush();

  static constexpr int kPoses = 8;  ///< At once.
  using Lanes = std::array<double, kPoses>;

  /// Where a bone is in the world in all poses, how it is turned (w, x, y, z), and its tip, where no bone is joined.
  struct Posed {
    std::array<Lanes, 3> head;
    std::array<Lanes, 4> turn;
    std::array<Lanes, 3> tip;
  };

  /// From which poses are seen: places, and the scale times the cosine and the sine of the headings.
  struct Frames {
    Lanes x, y, cosine, sine;
  };
  /// Where the tips of a pose go, from the offset on.
  struct Rows {
    float* rows;
    int stride;
  };

 private:
  Kinematics kinematics_;
  std::vector<int> measured_;  // the bones whose tips are seen
  std::vector<int> chains_;    // and those between them and the hips, but for these
  std::vector<int> joined_;    // of each of the measured ones, that of chains_ whose head is its tip, or -1
  std::vector<int> loose_;     // the measured ones without such
  double scale_;
  std::vector<Posed> posed_;
  std::array<std::vector<double>, kPoses> rotations_;
  Frames frames_{};
  std::array<Rows, kPoses> to_{};
  int count_ = 0;
};

}  // namespace fragmotion

// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "fragmotion/fragments/fragment.hpp"
#include "fragmotion/fragments/packed_pool.hpp"
#include "fragmotion/skeleton/two_bone_ik.hpp"

namespace fragmotion {

/// Bone tips as Dis sees them: x, y and z each in a row of floats, padded with zeros to whole blocks of kLanes.
constexpr int kLanes = 8;

/// Poses of a trajectory.
constexpr int kPoses = 16;

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
  /// Takes a pose: the hips' place and rotations [bones, 4] as in Clip.
  void pose(const Vector3& root, const double* rotations);
  /// Writes its tips as seen from `frame`, as points offset .. of three rows of `stride` floats.
  void write(const CharacterFrame& frame, float* rows, int stride, int offset) const;

 private:
  Kinematics kinematics_;
  std::vector<int> bones_;
  double scale_;
  PosedBones posed_;
};

/// The fragments as points of the space in which Dis is a norm. Lengths are those of a character of 1.8 m.
/// A trajectory is `poses` poses at equal times, all in the character frame of the first; `first` and `last` are the
/// fragment's end poses, each in its own character frame.
struct Trajectories {
  int count = 0;
  int tips = 0;              ///< Points of each pose, one behind another in a row; 0 where there is but one pose.
  int stride = 0;            ///< Floats in a row of a trajectory.
  int pose_stride = 0;       ///< Floats in a row of an end pose.
  std::vector<float> whole;  ///< [count, 3, stride]
  std::vector<float> first;  ///< [count, 3, pose_stride]
  std::vector<float> last;   ///< [count, 3, pose_stride]

  const float* trajectory(int i) const { return &whole[static_cast<std::size_t>(i) * 3 * stride]; }
  const float* first_pose(int i) const { return &first[static_cast<std::size_t>(i) * 3 * pose_stride]; }
  const float* last_pose(int i) const { return &last[static_cast<std::size_t>(i) * 3 * pose_stride]; }
};

/// The most poses of a trajectory: half a second sampled as often as any camera does it holds no more.
constexpr int kMostPoses = 1000;

/// Samples every fragment of the pool, packed or not, at `poses` times. Throws std::invalid_argument unless these are 2
/// to kMostPoses.
template <typename AnyClip>
Trajectories trajectories(const Pool<AnyClip>& pool, int poses = kPoses, int threads = 0);

/// How much of its motion decides how well a fragment joins on to another, s.
constexpr double kOpening = 0.1;

/// The first pose of each fragment and the one kOpening later, both in the character frame of the first: [fragments,
/// 3, padded(2 * tips)], as Dis sees them. The distance between two says how alike places and speeds are.
std::vector<float> openings(const PackedPool& pool, int threads = 0);

/// Dis(f, g) of two fragments: summed over corresponding poses.
float fragment_distance(const Trajectories& t, int f, int g);

/// Dis(p_m of f, p_1 of g) (Eq. 2).
float transition_distance(const Trajectories& t, int f, int g);

}  // namespace fragmotion

// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <vector>

#include "skeleton/body_tree.hpp"

namespace fragmotion {

/// Bones that hang on each other, from the trunk outward.
using Chain = std::vector<int>;

/// Of each pose the places of all bones' heads.
using Poses = std::vector<const Vector3*>;

/// Of a limb's length: by less than that the bones of two that are alike differ.
constexpr double kAlike = 0.05;
/// Of a leg's length: a bone that it begins with and that is shorter is a part of the trunk.
constexpr double kNoLegBone = 0.1;
/// Of a leg's length: the hind and the fore feet are apart along the ground by that at least.
constexpr double kTrunkLength = 0.3;
/// Of a limb's length: over the lowest end, or over the ground, what stands there is at most.
constexpr double kStands = 0.15;

/// Two limbs that are alike, and the bone that they hang on.
struct LimbPair {
  int node = -1;
  std::array<Chain, 2> chains;
  double length = 0;
};

/// How the bones of a body branch at rest, but for twist bones and what is none of the body's, and the poses in which
/// it is seen: of a motion, else the one at rest.
class BodyShape {
 public:
  /// All must outlive it.
  BodyShape(const Skeleton& skeleton, const BodyTree& tree, const ObservedPoses* motion);
  BodyShape(const BodyShape&) = delete;

  const Skeleton& skeleton() const { return *skeleton_; }
  const std::vector<Vector3>& rest() const { return rest_; }
  Poses resting() const { return {rest_.data()}; }
  const Quaternion& rest_rotation(int bone) const { return rotations_[bone]; }
  const Poses& poses() const { return poses_; }
  /// Whether the poses are a motion's.
  bool moves() const { return moves_; }
  /// The longest way from a leaf to another one, m.
  double size() const { return size_; }

  /// As its name tells.
  Side side(int bone) const { return sides_[bone]; }
  int parent(int bone) const { return parents_[bone]; }
  const std::vector<int>& children(int bone) const { return children_[bone]; }
  bool is_below(int bone, int ancestor) const;
  /// The leaves below a bone; 1 of a leaf.
  int leaves(int bone) const;

  /// From the bone above, m.
  double length(int bone) const { return (rest_[bone] - rest_[parents_[bone]]).norm(); }
  /// To the farthest below, m along the bones: from a bone, and from what it hangs on.
  double reach(int bone) const { return reach_[bone]; }
  double branch(int bone) const { return length(bone) + reach_[bone]; }
  /// From the bone on those that lead farthest.
  Chain chain_from(int bone) const;
  /// Whether a bone carries fingers or toes.
  bool has_fingers(int bone) const;

  /// How far down it is from one bone to another on the mean over poses, in lengths of the way.
  static double descent(const Poses& poses, int from, int to);

 private:
  void observe(const ObservedPoses* motion);
  void grow(const BodyTree& tree);
  double across_at(int bone) const;

  const Skeleton* skeleton_;
  std::vector<Vector3> rest_;
  std::vector<Quaternion> rotations_;
  Poses poses_;
  bool moves_ = false;
  std::vector<Side> sides_;
  std::vector<int> parents_;
  std::vector<std::vector<int>> children_;
  std::vector<double> reach_;
  double size_ = 0;
};

/// The pairs of limbs that are alike, of those that hang on the same bone and are not named of the same side.
std::vector<LimbPair> find_limb_pairs(const BodyShape& shape);

/// How far the ends of a pair's limbs are under their node, on the mean over poses, in lengths of the limbs.
double depth_of(const LimbPair& pair, const Poses& poses);

/// The limbs of a pair, of arms or of legs, with what is told of them by a look that is so sure.
std::array<Limb, 2> shaped_limbs(const BodyShape& shape, const LimbPair& pair, bool arms, double sure);

/// The head among the bones from the shoulders up (and their confidence, of a look that is so sure) of a body whose
/// limbs are told; none where they are not.
void find_shaped_head(const BodyShape& shape, Chain neck, double sure, BodyJoints& body);

}  // namespace fragmotion

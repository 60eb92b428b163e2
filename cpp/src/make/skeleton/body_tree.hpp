// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "skeleton/body_words.hpp"
#include "skeleton/skin.hpp"

namespace fragmotion {

/// A skeleton as its names tell it: which bones may be a body's, and how those hang on each other. Of a rig in layers
/// (Rigify's DEF-, ORG-, MCH- and controls) the body is one layer, whose bones often hang on those of the others.
struct BodyTree {
  explicit BodyTree(const Skeleton& skeleton, const Skin* skin = nullptr);

  /// What remains where names lie.
  void forget_names();

  /// Where names say left of what is right, and right of what is left.
  void swap_sides();

  int size() const { return static_cast<int>(names.size()); }
  bool is_below(int bone, int ancestor) const;
  /// The lowest bone that both are below or are; -1 where there is none.
  int common(int a, int b) const;

  double says(int bone, Role role) const { return said[bone][static_cast<int>(role)]; }

  std::vector<BoneName> names;
  std::vector<std::array<double, kRoles>> said;  ///< By the names; see says() in body_words.hpp.
  std::vector<bool> in_layer;
  std::vector<bool> in_body;               ///< Of the body's layer, and no helper by its name.
  std::vector<bool> twist;                 ///< By its name.
  std::vector<bool> bare;                  ///< See bare_bones(); none where no skin is known.
  std::vector<int> parents;                ///< Among the bones of the layer, -1 above.
  std::vector<int> depth;                  ///< Bones of the layer above.
  std::vector<std::array<bool, 2>> holds;  ///< Whether it, or a bone below it, is named of the left, of the right.

 private:
  void silence_numbered_limbs();
  void contradict_fore_legs();
};

/// Confidence of a bone by its name, and by its place among others.
constexpr double kNamed = 0.95, kByPlace = 0.75;

/// A limb from the trunk outward; -1 where a bone is not told.
struct Limb {
  static constexpr int kFirst = 0, kUpper = 1, kLower = 2, kEnd = 3, kTip = 4;  ///< kFirst: the shoulder; kTip: the toe
  std::array<int, 5> bones{-1, -1, -1, -1, -1};
  std::array<double, 5> confidence{};

  bool alone() const { return bones[kLower] < 0 && bones[kEnd] < 0; }
  bool empty() const { return alone() && bones[kUpper] < 0; }
  bool whole() const { return bones[kUpper] >= 0 && bones[kLower] >= 0 && bones[kEnd] >= 0; }
};

/// Of a limb at least: where its upper and lower bone and its end begin.
constexpr std::size_t kLimbJoints = 3;

/// By the bones of a limb what they are: a leg begins with its thigh.
using LimbRoles = std::array<Role, 5>;
constexpr LimbRoles kArmRoles = {Role::kShoulder, Role::kUpperArm, Role::kLowerArm, Role::kHand, Role::kFinger};
constexpr LimbRoles kLegRoles = {Role::kThigh, Role::kThigh, Role::kShin, Role::kFoot, Role::kToe};

/// A body's joints as one way of looking tells them.
struct BodyJoints {
  int hips = -1, head = -1;
  int chest = -1;  ///< What the arms hang on, where that is told without them.
  double hips_confidence = 0, head_confidence = 0;
  std::array<Limb, 2> arms, legs;  ///< left, right
  bool four_legged = false;        ///< The arms are fore legs.
};

/// As the names tell; none where they do not agree with each other and the hierarchy.
std::optional<BodyJoints> named_body(const BodyTree& tree);

/// The body of an animal that the skeleton's roles tell, or that stands on four legs: at rest, or where it stands on
/// none at rest, in the mean over its motion. None of another one.
std::optional<BodyJoints> four_legged_body(const Skeleton& skeleton, const BodyTree& tree, const ObservedPoses* motion);

/// As the shape tells; see find_role_map().
BodyJoints shaped_body(const Skeleton& skeleton, const BodyTree& tree, const ObservedPoses* motion);

/// Whether the feet that names tell point to where the names' left is on the body's right: level, to their toes, or to
/// their tips where nothing hangs from them.
bool points_to_wrong_sides(const Skeleton& skeleton, const BodyTree& tree, const ObservedPoses* motion,
                           const BodyJoints& named);

}  // namespace fragmotion

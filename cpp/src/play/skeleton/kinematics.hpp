// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "skeleton/skeleton.hpp"

namespace fragmotion {

/// Where a character stands and faces: x right, y forward, z up; ground projection and heading of the hips.
/// Heading 0 faces the world's +y; positive turns left (counter-clockwise from above), radians.
struct CharacterFrame {
  Vector2 position = Vector2::Zero();
  double heading = 0;

  Vector3 to_world(const Vector3& local) const;
  Vector3 to_local(const Vector3& world) const;
  Quaternion rotation() const {
    const PlaneTurn half(heading / 2);
    return {half.cosine, 0, 0, half.sine};
  }
};

/// Forward kinematics of one skeleton. Keeps what does not change from pose to pose; copies share it.
class Kinematics {
 public:
  explicit Kinematics(const Skeleton& skeleton);

  const Skeleton& skeleton() const { return parts_->skeleton; }
  int bones() const { return skeleton().size(); }

  /// The character frame of hips at `position` with world rotation `rotation`. Facing is told by the line from the left
  /// thigh to the right; without thighs by Blender's convention that a character at rest faces -y.
  CharacterFrame frame(const Vector3& position, const Quaternion& rotation) const;

  /// World positions (heads) and rotations of all bones. Bones above the hips rest relative to the character frame.
  /// `rotations` is one pose's [bones, 4] as in Clip; the outputs hold `bones()` values.
  void world(const Vector3& root_position, const double* rotations, Vector3* heads, Quaternion* orientations) const;

  /// Only the hips, the bones above them and those of `bones`, which hang on each other and on the hips, in order.
  void world(const Vector3& root_position, const double* rotations, const std::vector<int>& bones, Vector3* heads,
             Quaternion* orientations) const;

  /// Only the hips and those of `bones`.
  void world_below(const Vector3& root_position, const double* rotations, const std::vector<int>& bones, Vector3* heads,
                   Quaternion* orientations) const;

  /// The bones between the hips and those given, and these.
  std::vector<int> chains(const std::vector<int>& ends) const;

  /// The character frame of the rest pose.
  const CharacterFrame& rest_frame() const { return parts_->rest_frame; }

 private:
  struct Parts {
    Skeleton skeleton;
    std::vector<std::array<double, 4>> offsets;  // its own, and 0
    Vector3 right;                               // from the left thigh to the right one, in the hips' frame
    CharacterFrame rest_frame;
    std::vector<int> carried, below;  // bones outside the tree of the hips, and those in it but for the hips
    std::vector<Vector3> rest_heads;  // of all bones, in the character frame
    std::vector<Quaternion> rest_rotations;
  };
  void carry(const Vector3& root_position, const Quaternion& hips, Vector3* heads, Quaternion* orientations) const;

  std::shared_ptr<const Parts> parts_;
};

}  // namespace fragmotion

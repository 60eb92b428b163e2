// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "fragmotion/fragmotion.h"
#include "skeleton/kinematics.hpp"

namespace fragmotion {

/// How an engine sees what we have: its axes are ours, in another order and some turned about, times its unit. Where it
/// is left-handed the frames of bones are mirrored, too.
class Axes {
 public:
  Axes(FragmotionAxes axes, double unit);

  /// Whether there are such axes.
  static bool exist(FragmotionAxes axes) { return axes >= FRAGMOTION_AXES_BLENDER && axes <= FRAGMOTION_AXES_UNREAL; }

  double unit() const { return unit_; }
  double length(double metres) const { return unit_ * metres; }
  double metres(double units) const { return units / unit_; }
  /// A heading, or an angle about the up axis; and back.
  double yaw(double angle) const { return yaw_ * angle; }

  /// A direction and a place in the world or as the character sees it; and back.
  Vector3 direction(const Vector3& ours) const;
  Vector3 ours(const float theirs[3]) const;
  void write_place(const Vector3& ours, float* theirs) const;
  Vector3 place(const float theirs[3]) const { return ours(theirs) / unit_; }
  /// What an entity that has a heading is turned by.
  void write_heading(double heading, float rotation[4]) const;

  /// A bone's frame in the world or as the character sees it, and in its parent.
  FragmotionTransform global(const Vector3& place, const Quaternion& rotation) const;
  FragmotionTransform local(const Vector3& place, const Quaternion& rotation) const;

 private:
  Quaternion mirrored(const Quaternion& rotation) const;

  std::array<int, 3> from_{};  // theirs[i] = sign_[i] ours[from_[i]]
  std::array<double, 3> sign_{};
  std::array<double, 3> bone_;    // of places in a bone's frame
  std::array<double, 3> turn_{};  // of what rotations turn about in it
  Quaternion bones_;              // of the world's axes, seen from the bones'
  double yaw_, unit_;
};

}  // namespace fragmotion

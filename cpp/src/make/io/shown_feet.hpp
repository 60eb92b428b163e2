// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "motion/clip.hpp"
#include "skeleton/kinematics.hpp"
#include "skeleton/two_bone_ik.hpp"

namespace fragmotion {

/// Where the legs of an armature are shown to end, frame by frame. Bones that are moved away from their parents, or
/// scaled, end elsewhere than the rotations alone have it that a clip keeps.
class ShownFeet {
 public:
  /// The kinematics must outlive it.
  ShownFeet(const Kinematics& kinematics, int frames);

  const Legs& legs() const { return legs_; }
  void show(int frame, int leg, const Vector3& ankle) { ankles_[at(frame, leg)] = ankle; }

  /// Bends the legs of the clip so that they end where they are shown to, or as near as they are long, knees as they
  /// bend in it; feet stay turned as they are. None where all are there already, but for what files round off.
  void keep(Clip& clip) const;

 private:
  std::size_t at(int frame, int leg) const { return static_cast<std::size_t>(frame) * kMostLegs + leg; }
  bool are_kept(const Clip& clip) const;
  Legs bent_in(const Clip& clip) const;
  void pose(const Clip& clip, int frame, PosedBones& bones) const;

  const Kinematics& kinematics_;
  Legs legs_;
  std::vector<int> chains_;  // what bears the feet, from the hips on
  std::vector<Vector3> ankles_;
};

}  // namespace fragmotion

// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <string>
#include <vector>

#include "base/types.hpp"

namespace fragmotion {

/// What a bone is to the method; found (roles.cpp) or given. -1 where the skeleton has none.
struct Roles {
  int hips = -1;  ///< The bone that carries the body: the skeleton's root, though bones may stand above it.
  int head = -1;
  int left_hand = -1, right_hand = -1;
  int left_foot = -1, right_foot = -1;
  int left_toe = -1, right_toe = -1;
  int left_thigh = -1, right_thigh = -1;
  // Of a four-legged body, whose feet and thighs above are the hind ones.
  int left_fore_foot = -1, right_fore_foot = -1;
  int left_fore_toe = -1, right_fore_toe = -1;
  int left_fore_leg = -1, right_fore_leg = -1;  ///< Where the fore legs begin.
};

/// So much faster than ever in the takes a bone turns at most.
constexpr double kTurnsAtMost = 1.25;

/// How many legs a body has at most. Legs and feet are numbered: the left and the right one, and of a four-legged body
/// these are the hind ones, and the fore ones follow.
constexpr int kMostLegs = 4;

/// The roles of a leg's bones; -1 where it has none.
struct LegRoles {
  int thigh = -1, foot = -1, toe = -1;
};

std::array<LegRoles, kMostLegs> leg_roles(const Roles& roles);
/// Those of the legs up to a pair that has not both feet.
std::vector<LegRoles> legs_with_feet(const Roles& roles);

/// Bones in parent-before-child order, in metres. Exactly one bone, the first, has no parent (-1).
/// A bone's frame has its origin at the bone's head; `offset` is the head in the parent's frame, `rest_rotation` the
/// frame's rotation relative to the parent's at rest (for bone 0 both are relative to the world, z up), `tip` the tail
/// in the bone's own frame.
struct Skeleton {
  std::vector<std::string> names;
  std::vector<int> parents;
  std::vector<Quaternion> rest_rotations;
  std::vector<Vector3> offsets;
  std::vector<Vector3> tips;
  Roles roles;

  int size() const { return static_cast<int>(names.size()); }
  /// The bone's index, or -1.
  int find(const std::string& name) const;
  /// Whether `bone` is `ancestor` or below it.
  bool is_below(int bone, int ancestor) const;
};

/// Whether a bone lies between thigh and foot; so it is taken to be where one of them is not known.
bool has_knee(const Skeleton& skeleton, const LegRoles& leg);
inline bool leads_down(const Vector3& way) { return -way.z() > way.head<2>().norm(); }

/// Whether a leg ends in its thigh or its shin, which is its foot then: that leads down at rest, and no knee lies
/// above. It stands on its tip alone.
bool ends_without_foot(const Skeleton& skeleton, const LegRoles& leg);

/// Checks sizes, order, unique names, roles and finite numbers, and returns the skeleton, its rest rotations of unit
/// length. Throws std::invalid_argument that names the bone; also over 4,096 bones, on a name of more than 255 bytes
/// and on an offset or tip of more than 1,000 km.
Skeleton checked_skeleton(Skeleton skeleton);

/// For each bone its left/right counterpart by name (`.L`/`.R`, `_L`/`_R`, `Left`/`Right`, `lfemur`/`rfemur`), itself
/// where it has none.
std::vector<int> mirror_bones(const Skeleton& skeleton);

/// From the hip joint to the ankle, of the stature: thigh 0.245 and shank 0.246, Drillis and Contini, "Body Segment
/// Parameters" (1966), as in Winter, "Biomechanics and Motor Control of Human Movement", Fig. 4.1.
constexpr double kLegOfStature = 0.491;
/// The same to the ground: the foot's height is 0.039.
constexpr double kHipHeightOfStature = 0.53;

/// Height in metres of a person with these legs, whatever the rest pose and however head and toes end: a leg from hip
/// joint to ankle is 0.491 of it, to the end of one without a foot 0.53. Where no leg has its roles, the longest chain
/// of bones.
double stature(const Skeleton& skeleton);

/// Throws std::invalid_argument unless the stature is 1 mm to 10,000 km, so that distances are numbers.
void check_stature(const Skeleton& skeleton);

/// 1.8 m over the stature: distances are scaled by this, so that a number means the same on every rig.
double standard_scale(const Skeleton& skeleton);

/// The bones whose tips `Dis` (Sec. 3.1) sums over: the hips and all below, without fingers and face.
std::vector<int> measured_bones(const Skeleton& skeleton);

/// World position of each bone's head, and world rotation, at rest.
void rest_pose(const Skeleton& skeleton, std::vector<Vector3>& heads, std::vector<Quaternion>& rotations);

}  // namespace fragmotion

// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string>
#include <vector>

#include "skeleton/bone_names.hpp"
#include "skeleton/skeleton.hpp"
#include "skeleton/skin.hpp"

namespace fragmotion {

/// Of a foot's length: one that points less far ahead than that, and up or down, has no direction.
constexpr double kNoDirection = 0.3;
/// Cosine: directions that are nearer to each other point the same way.
constexpr double kSameWay = 0.5;

/// What a bone is to a body. Of spine, neck, fingers and toes there may be any number.
enum class Role {
  kRoot,  ///< The bone above the hips that nothing is above, where there is one.
  kHips,
  kSpine,  ///< From the hips upward.
  kNeck,   ///< From the arms upward.
  kHead,
  kShoulder,  ///< The collar bone.
  kUpperArm,
  kLowerArm,
  kHand,
  kFinger,
  kThigh,
  kShin,
  kFoot,
  kToe,
  // Of a four-legged body, whose thighs, feet and toes are the hind ones.
  kForeLeg,  ///< Where a fore leg begins.
  kForeFoot,
  kForeToe,
};

/// A bone that has a role. `confidence`, 0 to 1, is the more the better the name says it and the shape agrees: under
/// 0.5 nothing is told.
struct RoleBone {
  Role role = Role::kRoot;
  Side side = Side::kNone;
  int finger = -1;  ///< 0 thumb to 4 little finger.
  int order = 0;    ///< Among the bones of this role, side and finger; 0 is the first from the hips.
  int bone = -1;
  double confidence = 0;
};

/// A bone that shares the turn of a limb about its length: a part of the limb itself, or a bone beside it.
struct TwistBone {
  int bone = -1;
  int limb = -1;     ///< The bone with the role.
  double share = 0;  ///< Where along the limb it begins, 0 to 1.
};

/// What the bones of a skeleton are to a body. What is not told has no entry: control bones, helpers, hair, clothes.
struct RoleMap {
  std::vector<RoleBone> bones;  ///< No bone and no role, side, finger and order twice.
  std::vector<TwistBone> twists;

  /// The bone with this role, or -1.
  int bone(Role role, Side side = Side::kNone) const;
  /// All bones with this role but fingers, in order.
  std::vector<int> chain(Role role, Side side = Side::kNone) const;
  double confidence(Role role, Side side = Side::kNone) const;
};

/// World places of all bones' heads in some poses of a motion, z up: what says more than a rest pose does.
struct ObservedPoses {
  int poses = 0;
  std::vector<Vector3> heads;  ///< [poses, bones]
};

/// So many frames are those poses apart that are looked at of a motion, some 200 in all.
int frames_between_looks(int frames);

/// Whose left and right is told where names say left of all limbs that feet and knees say are right: a rig is named the
/// wrong way round, or a file is mirrored.
enum class Sides { of_the_body, of_the_names };

/// The roles that names tell, and where they say nothing the shape: pairs of limbs that are alike, the lengths of their
/// bones, what is lowest, where the feet point; by `motion` too, where given: which joints bend, to where knees do,
/// which way is up. Names that contradict the hierarchy tell nothing, nor does the shape what names contradict, but for
/// left and right, where `sides` are the body's. What stands on four legs at rest is told by its shape alone. Of two
/// feet of a leg that names tell, and of two legs that they name alike, it is the one that carries `skin`, where given.
RoleMap find_role_map(const Skeleton& skeleton, const ObservedPoses* motion = nullptr, Sides sides = Sides::of_the_body,
                      const Skin* skin = nullptr);

/// The bones of a map that the method needs; -1 where it has none.
Roles roles_of(const RoleMap& map);

/// A role's name for the user: "hips", "spine_2", "left_upper_arm", "right_index_1" ...; single roles and the first
/// toe have no number.
std::string role_label(const RoleBone& bone);
/// Of the first bone of a role.
std::string role_label(Role role, Side side);

/// Role -> bone's name, as a preset keeps it and role_map_of() reads it; twist bones are found again by the bones.
std::map<std::string, std::string> named_bones(const Skeleton& skeleton, const RoleMap& map);

/// The map that a user gives, with full confidence. Throws std::invalid_argument on an unknown role, on a bone that the
/// skeleton lacks and on one that is named twice.
RoleMap role_map_of(const Skeleton& skeleton, const std::map<std::string, std::string>& bones);

/// A map that was found, but for some roles that a user gives, as for role_map_of().
RoleMap with_told(const Skeleton& skeleton, const RoleMap& found, const std::map<std::string, std::string>& told);

}  // namespace fragmotion

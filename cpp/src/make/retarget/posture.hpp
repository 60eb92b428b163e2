// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "motion/contacts.hpp"
#include "skeleton/role_map.hpp"
#include "skeleton/two_bone_ik.hpp"

namespace fragmotion {

/// World places of heads and rotations at rest.
PosedBones rest_posture(const Skeleton& skeleton);

/// How a body holds itself on average while it is upright and slow in clips of it, facing +y, the hips' head at the
/// origin. None where it never is.
std::optional<PosedBones> mean_posture(const Kinematics& kinematics, const RoleMap& map,
                                       const std::vector<Clip>& clips);

/// Of each bone of arms and legs the axis, as it sees it, that elbow or knee bends about in clips; zero of other bones
/// and where they hardly bend.
std::vector<Vector3> mean_hinges(const Kinematics& kinematics, const RoleMap& map, const std::vector<Clip>& clips);

/// Whether knees bend to the back of a posture that faces +y, which they do about these hinges, or nothing is known of
/// any: files whose rotations were made of joints' places alone turn their bones otherwise than they rest.
bool bends_back(const RoleMap& map, const PosedBones& posture, const std::vector<Vector3>& hinges);

/// A foot that stands flat, as clips have it.
struct FlatFoot {
  bool known = false;
  Quaternion foot = Quaternion::Identity(), toe = Quaternion::Identity();  ///< World rotations of a body facing +y.
  FootHeights heights;                                                     ///< m
};

/// The left and the right foot where they stand flat and still in clips, on the ground on which most of that is: who
/// sits lets them hang.
std::array<FlatFoot, 2> flat_feet(const Kinematics& kinematics, const Legs& legs, const std::vector<Clip>& clips);

/// Turns a posture so that it faces +y and stands upright: about the vertical alone, unless the trunk leans far.
void face_forward(const RoleMap& map, PosedBones& posture);

/// Whether a posture that faces +y is one that a standing body may have: the trunk above straight legs, the arms
/// wherever they are held.
bool stands(const RoleMap& map, const PosedBones& posture);

/// The highest bone of the trunk: the head, else the last of neck, spine, or the hips.
int top_of(const RoleMap& map);

}  // namespace fragmotion

// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <utility>
#include <vector>

#include "motion/contacts.hpp"
#include "skeleton/role_map.hpp"
#include "skeleton/two_bone_ik.hpp"

namespace fragmotion {

/// A skeleton as a body: what its bones are, and the pose in which bodies are compared. In that pose a body faces +y,
/// its arms and fingers point straight to the sides, its legs straight down, its feet straight ahead and flat; trunk,
/// neck and head are as they stand.
struct Body {
  Kinematics kinematics;  ///< Of the skeleton with the roles of the map, and with the feet that it lacks (with_feet).
  RoleMap map;
  bool stands = false;                ///< Whether a rest pose or clips tell that pose; else it is a guess.
  std::vector<Quaternion> reference;  ///< World rotation of each bone in that pose.
  Legs legs;
  std::array<Vector3, 2> feet;  ///< From the foot's head to the ball in that pose, m.
  Floors soles;                 ///< Heights of ball and heel over the ground where a foot stands flat, m.
  double leg = 0;               ///< Length of thigh and shin, mean of both legs, m.
  double hip_width = 0;         ///< Between the thighs' heads, m.
  Skeleton given;               ///< Without feet that were added.

  Body(Kinematics posed, RoleMap roles) : kinematics(std::move(posed)), map(std::move(roles)) {}

  const Skeleton& skeleton() const { return kinematics.skeleton(); }
  bool has_added_feet() const { return given.size() < skeleton().size(); }
  const Skeleton& own_skeleton() const { return has_added_feet() ? given : skeleton(); }
};

/// The body of a skeleton by its map of roles. The pose is told by the rest pose where that is one of a standing body,
/// however its arms are held and wherever it faces, whose knees bend to its back in `clips` of it, else by how it goes
/// in these; flat feet by the clips where they stand in them; where hands without fingers point by `skin`, where given.
/// Throws std::invalid_argument naming what is missing of hips and legs, or hangs wrong.
Body make_body(const Skeleton& skeleton, const RoleMap& map, const std::vector<Clip>& clips = {},
               const Skin* skin = nullptr);

}  // namespace fragmotion

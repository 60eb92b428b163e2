// SPDX-License-Identifier: MIT
#pragma once

#include "skeleton/role_map.hpp"

namespace fragmotion {

/// A skeleton with the feet that it lacks, behind its own bones, and its map with them. Legs of thigh and shin alone,
/// as blocky characters have them, stand on the ends of their shins: there a foot is added that points ahead, where
/// both shins end lowest of the body and no bone is called a foot.
struct Footed {
  Skeleton skeleton;
  RoleMap map;
};

/// The map in which a foot is what leads ahead: where that of the map is a stub from the ankle down to the sole,
/// shorter than the toe on it, which leads ahead along the ground, the toe is the foot.
RoleMap with_feet_ahead(const Skeleton& skeleton, RoleMap map);

Footed with_feet(const Skeleton& skeleton, const RoleMap& map);

}  // namespace fragmotion

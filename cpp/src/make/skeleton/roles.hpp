// SPDX-License-Identifier: MIT
#pragma once

#include "skeleton/skeleton.hpp"

namespace fragmotion {

/// The checked_skeleton(), its `roles` filled where they are -1 with those of find_roles(). Throws
/// std::invalid_argument as that does.
Skeleton make_skeleton(Skeleton skeleton);

/// The roles that find_role_map() (role_map.hpp) tells from names, hierarchy and shape; where it tells no feet, and the
/// skeleton's own roles do not, the legs of tell_standing_legs(). Where nothing tells the hips, those are the first
/// bone with three children or more, else bone 0.
Roles find_roles(const Skeleton& skeleton);

}  // namespace fragmotion

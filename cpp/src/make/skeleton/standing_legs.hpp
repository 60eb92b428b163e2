// SPDX-License-Identifier: MIT
#pragma once

#include "skeleton/skeleton.hpp"

namespace fragmotion {

/// The roles of the legs of a body that find_role_map() tells none of, which may guess: pairs of limbs of two bones and
/// more, each the other's mirror image, that end lowest at rest, and the hips that carry them. Two pairs are those of
/// an animal on four legs; of more the middle one is told. Where neither names nor the head tell it, a body faces
/// Blender's front view, along -y. No role changes where no limbs stand so.
void tell_standing_legs(const Skeleton& skeleton, Roles& roles);

}  // namespace fragmotion

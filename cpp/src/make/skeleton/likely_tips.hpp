// SPDX-License-Identifier: MIT
#pragma once

#include "skeleton/role_map.hpp"
#include "skeleton/two_bone_ik.hpp"

namespace fragmotion {

/// Whether the tip of a bone leads on from the bone before it at rest, by 60 degrees at most. That of a hand or of a
/// finger that does not was made up by an importer of a format that knows no bones' ends.
bool leads_on(const Skeleton& skeleton, int before, int bone);

/// The skeleton with tips that hands and fingers can have: a hand's where the bones lead that hang on it but for the
/// thumb, else where its part of `skin` does, else, and of a finger's joints but the first, straight on from the bone
/// before it where it does not lead on.
Skeleton with_likely_tips(Skeleton skeleton, const RoleMap& map, const Skin* skin = nullptr);

/// The skeleton with likely ends of a pair's feet that have no toes: importers of formats that know no bones' ends make
/// such of any length, and such as point back up the leg, which are to point ahead.
Skeleton with_short_feet(Skeleton skeleton, const Leg& left, const Leg& right);
/// Of all its legs.
Skeleton with_short_feet(Skeleton skeleton);

}  // namespace fragmotion

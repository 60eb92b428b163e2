// SPDX-License-Identifier: MIT
#pragma once

#include "skeleton/skeleton.hpp"

namespace fragmotion {

/// The skeleton with legs that are told to end in no foot (ends_without_foot()) reaching the ground at rest: importers
/// know no bones' ends, and invent them. Where the ground is not below them, they are left.
Skeleton with_legs_to_ground(Skeleton skeleton, double ground);

}  // namespace fragmotion

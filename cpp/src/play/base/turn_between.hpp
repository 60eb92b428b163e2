// SPDX-License-Identifier: MIT
#pragma once

#include "base/types.hpp"

namespace fragmotion {

/// The least rotation that brings one direction to another: half a turn about any axis across where they are opposite,
/// and none where one of them is zero.
Quaternion turn_between(const Vector3& from, const Vector3& to);

}  // namespace fragmotion

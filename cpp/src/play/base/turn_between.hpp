// SPDX-License-Identifier: MIT
#pragma once

#include "base/types.hpp"

namespace fragmotion {

/// 1 + the cosine of an angle, below which half of the angle is not to be had from its cosine.
constexpr double kOpposite = 1e-6;

/// The least rotation that brings one direction to another: half a turn about any axis across where they are opposite,
/// and none where one of them is zero.
Quaternion turn_between(const Vector3& from, const Vector3& to);

}  // namespace fragmotion

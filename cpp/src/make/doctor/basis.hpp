// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "doctor/patient.hpp"

namespace fragmotion {

/// Cosine: a direction that is nearer to an axis is along it.
constexpr double kNearAxis = 0.8;

/// The axis nearest to a direction, where the angle between them is under 37 degrees; else zero.
Vector3 nearest_axis(const Vector3& direction);

/// "+X" to "-Z"; "" of zero.
std::string axis_name(const Vector3& axis);

/// From the feet to the head as the body moves: the nearest axis, or zero.
Vector3 up_axis(const Patient& patient);

/// The same of a body at rest that stands, with its legs under it: rest poses of some files are no pose of a body.
Vector3 standing_axis(const Patient& resting);

/// Where the feet of a body point that stands at rest: the nearest axis, or zero.
Vector3 front_axis(const Patient& resting);

}  // namespace fragmotion

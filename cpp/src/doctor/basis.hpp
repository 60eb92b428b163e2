// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "doctor/patient.hpp"

namespace fragmotion {

/// The take as if it had been read with other axes, and unit: every vector v becomes `scale` `basis` v, every rotation
/// R `basis` R `basis`^-1. The basis is orthogonal; one that mirrors makes the mirror image.
Take with_basis(Take take, const Eigen::Matrix3d& basis, double scale = 1);

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

// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "base/types.hpp"

namespace fragmotion {

/// Blender's rotation modes as quaternions and back; radians. Quaternions need not be unit. All throw
/// std::invalid_argument naming the frame (from 0) on numbers that are not finite and on zero quaternions.

/// angles [frames, 3] in the order X, Y, Z of the channels, whatever `order` is -> [frames, 4]. `order` is one of XYZ,
/// XZY, YXZ, YZX, ZXY, ZYX; in XYZ the rotation about X comes first, about fixed axes: Rz Ry Rx. Throws on another
/// order.
std::vector<double> euler_to_quaternion(const std::string& order, const double* angles, int frames);

/// Inverse of euler_to_quaternion: [frames, 4] -> [frames, 3]. Of the equivalent angles each frame has those nearest to
/// the frame before, the first frame those nearest to zero.
std::vector<double> quaternion_to_euler(const std::string& order, const double* rotations, int frames);

/// [frames, 4] as (angle, x, y, z) -> [frames, 4]. The axis need not be unit; a zero axis is no rotation.
std::vector<double> axis_angle_to_quaternion(const double* axis_angles, int frames);

/// [frames, 4] -> [frames, 4] as (angle, x, y, z), unit axis, angle in [0, 2 pi]: continuous where successive
/// quaternions are on the same side. No rotation has Blender's default axis, y.
std::vector<double> quaternion_to_axis_angle(const double* rotations, int frames);

}  // namespace fragmotion

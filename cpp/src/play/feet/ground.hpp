// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <optional>

#include "base/types.hpp"

namespace fragmotion {

/// The ground at a place.
struct GroundPoint {
  double height = 0;                  ///< m, in the world.
  Vector3 normal = Vector3::UnitZ();  ///< Of any length; one that points down is that of a face seen from below.
};

/// The ground as a character asks for it, at most 8 times a step, and up to 80 in a reset: the first that a ray
/// downward from a place meets, or none. It is taken to stay as it is while a foot is above it. What is not finite, a
/// height beyond a million km and a normal without length (1e-100 to 1e100) count as none.
using Ground = std::function<std::optional<GroundPoint>(const Vector3& from)>;

}  // namespace fragmotion

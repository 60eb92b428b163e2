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

/// The ground as a character asks for it, some fifty times a step: the first that a ray downward from a place meets, or
/// none. What is not finite, a height beyond a million km and a normal without length (1e-100 to 1e100) count as none.
using Ground = std::function<std::optional<GroundPoint>(const Vector3& from)>;

}  // namespace fragmotion

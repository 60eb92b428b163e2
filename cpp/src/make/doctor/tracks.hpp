// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "motion/foot_paths.hpp"

namespace fragmotion {

class Patient;

/// What a clip of the take on its own skeleton tells.
struct Tracks {
  std::vector<Vector3> hips;  ///< [frames] m
  FootPaths feet;             ///< As foot_paths().
  std::vector<int> torn;      ///< As discontinuities().
};

/// Of the patient's take, a piece after another; nothing where it cannot be a clip.
std::optional<Tracks> tracks_of(const Patient& patient);

}  // namespace fragmotion

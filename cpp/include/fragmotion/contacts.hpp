// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <vector>

#include "fragmotion/kinematics.hpp"

namespace fragmotion {

/// Which feet stand on the ground in each frame of a clip.
struct Contacts {
  std::array<std::vector<bool>, 2> feet;  ///< left, right: [frames]; empty where the skeleton has no feet
};

/// A foot stands while its lower end is within 4.5 cm of its lowest in the take and nearly still: slower than
/// 0.5 m/s plus a fifth of the hips' speed (lengths of a character of 1.8 m). Gaps and contacts shorter than 0.06 s are
/// closed.
Contacts find_contacts(const Kinematics& kinematics, const Clip& clip);

/// The frames in which a foot strikes the ground, in order: the gait events between fragments.
std::vector<int> foot_strikes(const Contacts& contacts);

}  // namespace fragmotion

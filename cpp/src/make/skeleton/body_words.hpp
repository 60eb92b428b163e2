// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "skeleton/bone_names.hpp"
#include "skeleton/role_map.hpp"

namespace fragmotion {

constexpr int kRoles = static_cast<int>(Role::kToe) + 1;
constexpr double kContradicts = -1e9;  ///< A name that says something else.

/// By role how well a name says that its bone has it: 3 means that it says so, 0 that it says nothing of the body,
/// kContradicts that it says another role. Words that stand for other roles on other rigs ("leg", "shoulder") score
/// less.
std::array<double, kRoles> says(const BoneName& name);

/// How a skeleton numbers its fingers: from `first`, and where one of them is told by one digit a second one is its
/// joint (Biped: Finger01 is the second bone of Finger0).
struct FingerNumbers {
  int first = 1;
  bool one_digit = false;
};

/// Which finger a name says, 0 thumb to 4 little finger, or -1.
int finger_of(const BoneName& name, const FingerNumbers& usual);

/// Markers, controls, clothes and faces carry the name of the bone they serve.
bool says_helper(const BoneName& name);

/// Whether a name says that its bone shares the turn of a limb.
bool says_twist(const BoneName& name);

}  // namespace fragmotion

// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <vector>

#include "skeleton/body_tree.hpp"

namespace fragmotion {

/// A pose of a body: the places of all bones' heads, z up, and from where to where each leg's foot goes, zero where
/// that is not known.
struct PosedFeet {
  const Vector3* heads = nullptr;
  std::array<Vector3, 2> feet;
};

/// From the second of a pair of limbs to the first.
Vector3 across(const std::array<Limb, 2>& limbs, const Vector3* heads);

/// Puts the left limbs of a body with whole legs before the right ones, as its feet point and its knees bend in the
/// poses in which it stands, and drops the arms where that does not tell theirs. False where it is not told, or feet
/// and knees tell it otherwise.
bool put_left_first(const std::vector<PosedFeet>& poses, BodyJoints& body);

}  // namespace fragmotion

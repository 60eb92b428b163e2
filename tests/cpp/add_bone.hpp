// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "skeleton/skeleton.hpp"

namespace fragmotion {

/// Appends a bone, whose frame is the world's axes at rest unless it is told; returns its number.
inline int add_bone(Skeleton& skeleton, const std::string& name, int parent, const Vector3& offset, const Vector3& tip,
                    const Quaternion& rest = Quaternion::Identity()) {
  skeleton.names.push_back(name);
  skeleton.parents.push_back(parent);
  skeleton.rest_rotations.push_back(rest);
  skeleton.offsets.push_back(offset);
  skeleton.tips.push_back(tip);
  return skeleton.size() - 1;
}

}  // namespace fragmotion

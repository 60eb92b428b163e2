// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "retarget/body.hpp"

namespace fragmotion {

/// What a bone of the target follows: world rotation = that of a bone of the source times `turn`.
struct Lead {
  int bone = -1;
  Quaternion turn = Quaternion::Identity();
};

/// A bone of the target and what it follows: the first of two leads, or, by `weight`, something between them.
struct Drive {
  int bone = -1;
  Lead first, second;
  double weight = 0;
};

/// Whether both are one body, but for scale, names and the bones' frames.
bool same_body(const Body& source, const Body& target);

/// The bones of the target that follow the source.
std::vector<Drive> find_drives(const Body& source, const Body& target);

}  // namespace fragmotion

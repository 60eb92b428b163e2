// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "skeleton/role_map.hpp"

namespace fragmotion {

/// A bone of which it is doubtful that it is what a map takes it for, and why.
struct RoleDoubt {
  std::string role;  ///< See role_label().
  int bone = -1;
  std::string text;  ///< For people: what is doubtful, and what to do.
};

/// What of a map a person should look at before motion is brought onto the skeleton: bones that their place alone
/// tells, a joint too many in a leg, legs that end far over the ground or hang on a bone between the feet, and hands
/// whose direction nothing tells, nor `skin` where given. At most one doubt a bone.
std::vector<RoleDoubt> find_doubts(const Skeleton& skeleton, const RoleMap& map, const Skin* skin = nullptr);

}  // namespace fragmotion

// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "skeleton/skeleton.hpp"

namespace fragmotion {

/// The roles' names as the user meets them, in the order of policy files: hips, head, left_hand, right_hand ... Those
/// of fore legs are the last ones, after as many as every policy file has.
constexpr std::size_t kRolesOfAll = 10;
const std::vector<std::pair<std::string, int Roles::*>>& role_names();

/// Sets the skeleton's roles as `bones` (role -> bone's name) says and leaves the others. Throws std::invalid_argument
/// on an unknown role (listing the known ones) and on a bone that the skeleton lacks.
void assign_roles(const std::map<std::string, std::string>& bones, Skeleton& skeleton);

/// Role -> bone's name, for the roles that the skeleton has.
std::map<std::string, std::string> named_roles(const Skeleton& skeleton);

}  // namespace fragmotion

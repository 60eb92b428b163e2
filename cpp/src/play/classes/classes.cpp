// SPDX-License-Identifier: MIT
#include "classes/classes.hpp"

#include <cstddef>

namespace fragmotion {

std::vector<std::vector<int>> Classes::members() const {
  std::vector<std::vector<int>> members(count);
  for (std::size_t i = 0; i < labels.size(); ++i) members[labels[i]].push_back(static_cast<int>(i));
  return members;
}

}  // namespace fragmotion

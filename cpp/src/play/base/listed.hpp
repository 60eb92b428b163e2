// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace fragmotion {

/// Names for a message: "a, b, c".
inline std::string listed(const std::vector<std::string>& names) {
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
  return list;
}

}  // namespace fragmotion

// SPDX-License-Identifier: MIT
#include "fragments/fragment.hpp"

namespace fragmotion {

const char* origin_name(Origin origin) {
  static constexpr const char* kNames[] = {"captured", "mirrored", "interpolated", "transformed"};
  return kNames[static_cast<int>(origin)];
}

}  // namespace fragmotion

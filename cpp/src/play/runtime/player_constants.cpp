// SPDX-License-Identifier: MIT
#include "runtime/player_constants.hpp"

#include <limits>
#include <stdexcept>

#include "base/ranges.hpp"

namespace fragmotion {

PlayerConstants player_constants(const std::map<std::string, double>& values) {
  PlayerConstants constants;
  std::map<std::string, double*> known;
  for_each_constant(constants, [&](const char* name, double& value) { known[name] = &value; });
  for (const auto& [name, value] : values) {
    const auto found = known.find(name);
    if (found == known.end()) throw std::invalid_argument("the player has no constant \"" + name + "\"");
    require_range(("the constant " + name).c_str(), value, std::numeric_limits<double>::min(), 1000);
    *found->second = value;
  }
  return constants;
}

}  // namespace fragmotion

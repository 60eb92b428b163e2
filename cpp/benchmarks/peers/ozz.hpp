// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>

#include "character/character.hpp"

namespace fragmotion::benchmarks {

/// Registers what a frame takes in ozz-animation on the bones of a character, by name: two of its takes sampled and
/// blended, and all bones brought from their parents to the model. Without ozz-animation, nothing.
void register_ozz_frame(const std::string& name, const std::shared_ptr<const Character>& character);

}  // namespace fragmotion::benchmarks

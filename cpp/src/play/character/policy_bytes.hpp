// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "character/character.hpp"

namespace fragmotion {

/// to_bytes() of a character that from_bytes() may refuse: what a forger would write.
std::string unchecked_bytes(const Character& character);

/// What a file ends with: of words of 8 bytes, the last one filled up with zeros.
std::uint64_t policy_checksum(std::string_view payload);

}  // namespace fragmotion

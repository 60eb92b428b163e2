// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

#include "fragmotion/character.hpp"

namespace fragmotion {

/// A character as bytes: "FRAGMOTN", version, length, payload, FNV-1a checksum of the payload; little-endian.
std::string to_bytes(const Character& character);

/// The character in `bytes`. No length in them is trusted. Throws std::invalid_argument that begins with `name` and
/// says why the bytes are refused: no policy file, another version, cut short, damaged, or inconsistent.
Character from_bytes(const std::string& bytes, const std::string& name = "policy");

/// Writes a policy file: to a temporary file beside it, then renamed. Throws std::invalid_argument naming the path.
void save_policy(const std::filesystem::path& path, const Character& character);

/// Reads a policy file; throws as from_bytes.
Character load_policy(const std::filesystem::path& path);

}  // namespace fragmotion

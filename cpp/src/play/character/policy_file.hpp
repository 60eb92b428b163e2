// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "character/character.hpp"

namespace fragmotion {

/// What policy files begin with; their version follows.
constexpr std::string_view kPolicyMagic = "FRAGMOTN";

/// Of the files that are written, and of the oldest ones that are read.
constexpr std::uint32_t kPolicyVersion = 6, kOldestPolicyVersion = 3;

/// A character as bytes: "FRAGMOTN", version, length, payload, checksum of the payload (docs/game.md); little-endian.
/// Throws std::invalid_argument on a character that from_bytes would refuse.
std::string to_bytes(const Character& character);

/// The character in `bytes`, which takes at most 20 times as much memory beyond 50 MB. No length and no number in them
/// is trusted: whatever is accepted plays finite poses. Throws std::invalid_argument that begins with `name` and says
/// why the bytes are refused: no policy file, another version, cut short, damaged, inconsistent, or out of proportion.
Character from_bytes(std::string_view bytes, const std::string& name = "policy");

/// Writes a policy file whole or not at all, and safely while others read or write it; the permissions of a file that
/// it replaces stay. Throws std::invalid_argument naming the path, also where a symbolic link or anything else than a
/// regular file stands there, and as to_bytes.
void save_policy(const std::filesystem::path& path, const Character& character);

/// Reads a policy file, which a symbolic link may lead to. Throws as from_bytes, and on what is no regular file (a pipe
/// or a device has no end) or larger than 2 GB.
Character load_policy(const std::filesystem::path& path);

}  // namespace fragmotion

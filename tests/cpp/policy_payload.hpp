// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "character/policy_file.hpp"
#include "small_character.hpp"

namespace fragmotion {

/// The file of tiny_character().
inline const std::string& tiny_file() {
  static const std::string bytes = to_bytes(tiny_character());
  return bytes;
}

/// Of words of 8 bytes, as docs/game.md says.
inline std::uint64_t checksum_of(std::string payload) {
  payload.resize((payload.size() + 7) / 8 * 8, '\0');
  std::uint64_t hash = 14695981039346656037ULL;
  for (std::size_t at = 0; at < payload.size(); at += 8) {
    for (std::size_t byte = 0; byte < 8; ++byte) {
      hash ^= std::uint64_t{static_cast<unsigned char>(payload[at + byte])} << 8 * byte;
    }
    hash *= 1099511628211ULL;
    hash ^= hash >> 32;
  }
  return hash;
}

/// A file around a payload: magic, version, length, payload, checksum.
inline std::string file_around(const std::string& payload) {
  std::string bytes = tiny_file().substr(0, 12);
  const std::uint64_t numbers[] = {payload.size(), checksum_of(payload)};
  bytes.append(reinterpret_cast<const char*>(&numbers[0]), 8);
  bytes += payload;
  bytes.append(reinterpret_cast<const char*>(&numbers[1]), 8);
  return bytes;
}

inline std::string payload_of(const std::string& bytes) { return bytes.substr(20, bytes.size() - 28); }

/// Where bytes of a tiny file, or of its payload, are spoilt: everywhere but in the control model, of whose
/// probabilities, all alike, each 101st byte is.
inline std::vector<std::size_t> spots(std::size_t size) {
  constexpr std::size_t kModel = sizeof(float) * kPaperPoints * kPaperPoints, kAfter = 1000;
  std::vector<std::size_t> spots;
  for (std::size_t at = 0; at < size; at += at + kAfter + kModel < size || at + kAfter >= size ? 1 : 101) {
    spots.push_back(at);
  }
  return spots;
}

}  // namespace fragmotion

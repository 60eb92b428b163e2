// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <cstring>
#include <memory>
#include <string>

#include "fragmotion/character/policy_file.hpp"
#include "fragmotion/runtime/player.hpp"
#include "fuzzing.hpp"

namespace fragmotion {

// Of a policy file's bytes all but a few thousand are the 102 x 102 probabilities of controls. A core is a file's
// payload without them: small enough to keep, and every byte that is changed in it counts.

constexpr std::uint64_t kProbabilities = kPaperPoints * kPaperPoints;
constexpr std::size_t kHeaderBytes = 20, kChecksumBytes = 8;

template <typename T>
std::string bytes_of(const T& value) {
  std::string bytes(sizeof(T), '\0');
  std::memcpy(bytes.data(), &value, sizeof(T));
  return bytes;
}

inline std::string core_of(const std::string& file) {
  std::string payload = file.substr(kHeaderBytes, file.size() - kHeaderBytes - kChecksumBytes);
  const std::size_t at = payload.find(bytes_of(kProbabilities));
  return payload.erase(at + 8, 8 * kProbabilities);
}

/// The file with this core, its length and its checksum right; a control is followed by itself.
inline std::string file_with_core(std::string payload) {
  const std::size_t at = payload.find(bytes_of(kProbabilities));
  if (at != std::string::npos) {
    std::string model;
    for (std::uint64_t i = 0; i < kProbabilities; ++i) model += bytes_of(i % (kPaperPoints + 1) == 0 ? 1.0 : 0.0);
    payload.insert(at + 8, model);
  }
  std::uint64_t hash = 14695981039346656037ULL;  // FNV-1a
  for (const char byte : payload) hash = (hash ^ static_cast<unsigned char>(byte)) * 1099511628211ULL;
  return "FRAGMOTN" + bytes_of(std::uint32_t{3}) + bytes_of(std::uint64_t{payload.size()}) + payload + bytes_of(hash);
}

/// A second of play under several controls, whose poses must be numbers.
inline void play(Character character) {
  const auto shared = std::make_shared<const Character>(std::move(character));
  Player player(shared);
  for (const Control& control :
       {Control{}, Control{0, 1.2}, Control{-2, 3, 1}, Control{0, -1.2, -1, 1}, Control{0, 9}}) {
    for (int frame = 0; frame < 12; ++frame) {
      player.step(control, 1.0 / 60);
      require(player.root_position().allFinite() && all_finite(player.rotations()), "poses are numbers");
    }
  }
}

}  // namespace fragmotion

// SPDX-License-Identifier: MIT
#include "character/policy_file.hpp"

#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <utility>

#include "base/fnv.hpp"
#include "base/read_file.hpp"
#include "base/write_file.hpp"
#include "character/check_character.hpp"
#include "character/policy_bytes.hpp"
#include "character/policy_content.hpp"
#include "fragments/body_tips.hpp"
#include "fragments/entry_poses.hpp"
#include "fragments/whole_jumps.hpp"
#include "skeleton/two_bone_ik.hpp"

namespace fragmotion {
namespace {

constexpr std::size_t kHeader = kPolicyMagic.size() + 4 + 8, kChecksum = 8;
// Memory of the entry poses, which a player needs beside the file: a file takes at most 20 times its size, beyond 50
// MB.
constexpr std::size_t kTimes = 16;  // bytes for each of the file

// Of files of version 3.
std::uint64_t checksum_of_bytes(std::string_view payload) { return fnv1a(payload.data(), payload.size()); }

// That the entry poses of a file of `size` bytes are in proportion.
void check_memory(const Character& c, std::size_t size) {
  std::size_t fragments = kMoveParts * c.moves.size();
  for (int style = 0; style < c.style_count(); ++style) fragments += c.in_style(style).pool.fragments.size();
  const std::size_t tips = measured_bones(c.pool.skeleton).size(),
                    bytes = fragments * 3 * padded(2 * static_cast<int>(tips)) * sizeof(float);
  if (bytes <= kPolicyRoom + kTimes * size) return;
  throw std::invalid_argument(std::to_string(fragments) + " fragments of " + std::to_string(tips) +
                              " bones would take " + std::to_string(bytes / 1000000) + " MB of memory, more than " +
                              std::to_string(kPolicyRoom / 1000000) + " MB and " + std::to_string(kTimes) +
                              " times the file's size");
}

// Makes anew what a file of this version does not hold.
void complete(Character& c, std::uint32_t version) {
  Legs legs = resting_legs(c.pool.skeleton);
  for (int leg = 0; leg < kMostLegs; ++leg) legs[leg].hinge = c.legs[leg].hinge;
  c.legs = std::move(legs);
  if (version < 5) repair_policies(c);
  find_whole_jumps(c.pool);
  c.entry_poses = entry_poses(c.pool);
  c.speeds = SpeedRange(c.pool.fragments, c.space);
  c.move_parts = move_parts(c.pool, c.moves);
}

// The same, of all styles.
void complete_looks_and_arms(Character& c, std::uint32_t version) {
  const std::array<Arm, 2> arms = resting_arms(c.pool.skeleton);
  for (int side = 0; side < 2; ++side) {
    const Vector3 hinge = c.arms[side].arm.hinge;
    c.arms[side].arm = arms[side];
    c.arms[side].arm.hinge = hinge;
  }
  if (version < 6) measure_looks_and_arms(c);
  check_looks_and_arms(c);
}

}  // namespace

// Each word is folded, so that its high bits are mixed as well.
std::uint64_t policy_checksum(std::string_view payload) {
  std::uint64_t hash = kFnvSeed;
  const auto mix = [&](std::size_t at, std::size_t bytes) {
    std::uint64_t word = 0;
    std::memcpy(&word, payload.data() + at, bytes);
    hash = (hash ^ word) * kFnvPrime;
    hash ^= hash >> 32;
  };
  std::size_t at = 0;
  for (; at + sizeof hash <= payload.size(); at += sizeof hash) mix(at, sizeof hash);
  if (at < payload.size()) mix(at, payload.size() - at);
  return hash;
}

std::string unchecked_bytes(const Character& character) {
  PolicyWriter payload;
  exchange(payload, const_cast<Character&>(character));
  PolicyWriter file;
  file.raw(kPolicyMagic.data(), kPolicyMagic.size());
  file.number<std::uint32_t>(kPolicyVersion);
  file.number<std::uint64_t>(payload.bytes.size());
  file.bytes += payload.bytes;
  file.number<std::uint64_t>(policy_checksum(payload.bytes));
  return file.bytes;
}

std::string to_bytes(const Character& character) {
  try {
    check_character(character);
    check_looks_and_arms(character);
    std::string bytes = unchecked_bytes(character);
    check_memory(character, bytes.size());
    return bytes;
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(std::string("the policy cannot be saved: ") + error.what());
  }
}

Character from_bytes(std::string_view bytes, const std::string& name) {
  try {
    if (bytes.size() < kHeader || bytes.substr(0, kPolicyMagic.size()) != kPolicyMagic) {
      throw std::invalid_argument("it is no Fragmotion policy file");
    }
    std::uint32_t version = 0;
    std::uint64_t length = 0;
    std::memcpy(&version, bytes.data() + 8, 4);
    std::memcpy(&length, bytes.data() + 12, 8);
    if (version < kOldestPolicyVersion || version > kPolicyVersion) {
      const std::string which = "it is of version " + std::to_string(version) + ", and this program reads versions " +
                                std::to_string(kOldestPolicyVersion) + " to " + std::to_string(kPolicyVersion);
      throw std::invalid_argument(which +
                                  (version > kPolicyVersion ? ": get a newer Fragmotion" : ": build the policy again"));
    }
    if (bytes.size() < kHeader + kChecksum || length != bytes.size() - kHeader - kChecksum) {
      throw std::invalid_argument("it is cut short or has bytes too many");
    }
    std::uint64_t expected = 0;
    std::memcpy(&expected, bytes.data() + kHeader + length, 8);
    const auto sum_of = version < 4 ? checksum_of_bytes : policy_checksum;
    if (sum_of(bytes.substr(kHeader, length)) != expected) throw std::invalid_argument("it is damaged (checksum)");
    Character character;
    PolicyReader reader(version, bytes.data() + kHeader, length);
    exchange(reader, character);
    if (!reader.done()) throw std::invalid_argument("it has bytes too many");
    check_character(character);
    check_memory(character, bytes.size());
    complete(character, version);
    complete_looks_and_arms(character, version);
    for (const auto& style : character.styles) {
      auto& other = const_cast<Character&>(*style);  // which from_bytes() made
      complete(other, version);
      other.looks = character.looks;
      other.arms = character.arms;
    }
    return character;
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(name + " is refused: " + error.what());
  }
}

void save_policy(const std::filesystem::path& path, const Character& character) {
  write_file(path, to_bytes(character));
}

Character load_policy(const std::filesystem::path& path) {
  return from_bytes(read_file(path), path.filename().u8string());
}

}  // namespace fragmotion

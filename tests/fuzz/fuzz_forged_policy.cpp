// SPDX-License-Identifier: MIT
// Policy files whose length and checksum are put right after the change: the checks of what they hold are all that
// stands before the player.
#include "character/policy_bytes.hpp"
#include "forger.hpp"
#include "policies.hpp"

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);

/// Changes a part of the character that a core holds, or seldom any bytes of it. Of a core that cannot be read there is
/// nothing to be told: the last that could be takes its place.
extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most, unsigned seed) {
  using namespace fragmotion;
  static std::string readable;
  if (seed % 32 == 0) return LLVMFuzzerMutate(data, size, most);
  Character character;
  try {
    character = from_bytes(file_with_core(text_of(data, size)));
    readable = text_of(data, size);
  } catch (const std::invalid_argument&) {
    if (readable.empty()) return LLVMFuzzerMutate(data, size, most);
    character = from_bytes(file_with_core(readable));
  }
  Forger(seed).forge(character);
  const std::string core = core_of(unchecked_bytes(character));
  if (core.size() > most) return LLVMFuzzerMutate(data, size, most);
  std::memcpy(data, core.data(), core.size());
  return core.size();
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace fragmotion;
  static Count played("stat::played_policies");
  Character character;
  try {
    character = from_bytes(file_with_core(text_of(data, size)));
  } catch (const std::invalid_argument&) {
    return 0;
  }
  play(std::move(character));
  ++played.value;
  return 0;
}

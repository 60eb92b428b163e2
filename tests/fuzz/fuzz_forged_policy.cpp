// SPDX-License-Identifier: MIT
// Policy files whose length and checksum are put right after the change: the checks of what they hold are all that
// stands before the player.
#include "policies.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace fragmotion;
  Character character;
  try {
    character = from_bytes(file_with_core(text_of(data, size)));
  } catch (const std::invalid_argument&) {
    return 0;
  }
  play(std::move(character));
  return 0;
}

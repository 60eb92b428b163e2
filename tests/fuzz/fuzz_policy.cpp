// SPDX-License-Identifier: MIT
// Policy files as they come: what is not of this program's making must not pass the checksum, and mostly does not.
#include "policies.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace fragmotion;
  read_or_refuse([&] { play(from_bytes(text_of(data, size))); });
  return 0;
}

// SPDX-License-Identifier: MIT
#include "fuzzing.hpp"
#include "io/parse_text.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace fragmotion;
  read_or_refuse([&] { check_take(parse_bvh(text_of(data, size), "fuzz.bvh", 0.01), size); });
  return 0;
}

// SPDX-License-Identifier: MIT
#include "control/parse_trace.hpp"
#include "fuzzing.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace fragmotion;
  read_or_refuse([&] {
    const Trace trace = parse_trace(text_of(data, size), "fuzz.csv");
    require(trace.size() >= 2 && trace.size() <= size / 8 + 1, "a control a row");
    for (const Control& c : trace) {
      require(std::isfinite(c.speed()) && std::abs(c.turn) <= 6 && c.jump >= 0 && c.jump <= 1, "controls in range");
    }
  });
  return 0;
}

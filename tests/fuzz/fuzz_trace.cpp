// SPDX-License-Identifier: MIT
#include "base/utf8.hpp"
#include "control/parse_trace.hpp"
#include "fuzzing.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace fragmotion;
  read_or_refuse([&] {
    const auto [trace, asked] = parse_trace(text_of(data, size), "fuzz.csv");
    require(trace.size() >= 2 && trace.size() <= size / 8 + 1, "a control a row");
    for (const Control& c : trace) {
      require(std::isfinite(c.speed()) && std::abs(c.turn) <= 6 && c.jump >= 0 && c.jump <= 1, "controls in range");
    }
    const auto controls = static_cast<int>(trace.size());
    int first = 0;
    for (const Asked::Move& move : asked.moves) {
      require(move.control >= first && move.held >= 1 && move.held <= controls - move.control, "moves in the trace");
      require(!move.name.empty() && is_utf8(move.name), "moves have names");
      first = move.control;
    }
    const Asked::Style* former = nullptr;
    for (const Asked::Style& style : asked.styles) {
      require(style.control < controls && !style.name.empty() && is_utf8(style.name), "styles in the trace");
      require(former == nullptr || (former->control < style.control && former->name != style.name), "styles change");
      former = &style;
    }
  });
  return 0;
}

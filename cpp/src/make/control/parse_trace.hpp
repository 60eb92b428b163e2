// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "control/trace.hpp"

namespace fragmotion {

/// What a trace file holds.
struct TraceFile {
  Trace trace;
  Asked asked;
};

/// read_trace() and read_asked() of a text at hand; `file` names it in errors.
TraceFile parse_trace(const std::string& text, const std::string& file);

}  // namespace fragmotion

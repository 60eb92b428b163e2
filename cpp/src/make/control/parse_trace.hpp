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

/// read_trace() and read_asked() of a file's bytes; `file` names it in errors.
TraceFile parse_trace(std::string bytes, const std::string& file);

}  // namespace fragmotion

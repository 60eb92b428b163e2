// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "fragmotion/control/trace.hpp"

namespace fragmotion {

/// read_trace() of a text at hand; `file` names it in errors.
Trace parse_trace(const std::string& text, const std::string& file);

}  // namespace fragmotion

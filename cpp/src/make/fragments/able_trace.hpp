// SPDX-License-Identifier: MIT
#pragma once

#include "control/trace.hpp"
#include "fragments/speed_range.hpp"

namespace fragmotion {

/// What a character does of a trace that goes so fast in each direction at most.
Trace able_trace(const SpeedRange& speeds, Trace trace);

}  // namespace fragmotion

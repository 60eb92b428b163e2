// SPDX-License-Identifier: MIT
#include "fragments/able_trace.hpp"

namespace fragmotion {

Trace able_trace(const SpeedRange& speeds, Trace trace) {
  for (Control& control : trace) control = speeds.within(control);
  return trace;
}

}  // namespace fragmotion

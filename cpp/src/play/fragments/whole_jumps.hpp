// SPDX-License-Identifier: MIT
#pragma once

#include "fragments/fragment.hpp"

namespace fragmotion {

/// Makes each fragment that jumps a whole jump: its lead_in begins where the hips, high before they crouch for the
/// take-off, begin to sink, at most 0.6 s before the crouch is deepest, and its lead_out ends where the hips, deep
/// after the landing, are up again, at most 0.6 s after that. Neither leaves the clip. The others get none.
template <typename AnyClip>
void find_whole_jumps(Pool<AnyClip>& pool);

}  // namespace fragmotion

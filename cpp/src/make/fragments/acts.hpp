// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "fragments/fragment.hpp"

namespace fragmotion {

/// How many words a clip's name has beside "idle", as stands are called in games: 0 of "Armature|Idle_2", 1 of
/// "SitIdle"; -1 where it has not that.
int words_beside_idle(const std::string& name);

/// Leaves acts out of the pool: what waves, shoots, sits, dies or boxes, which nobody asks for who lets go of the
/// stick. A clip is one that rests, slower than half a walk, for longer than it goes or turns, and does not jump. Of
/// such clips whose names hold the word "idle", those that are named so by the fewest words are no acts, but how the
/// body stands. Where there are any, or where the clips that are no acts rest for kStandsLong in all, the fragments in
/// which acts rest are left out. Needs the fragments' evident controls.
void drop_acts(FragmentPool& pool, const ControlSpace& space);

}  // namespace fragmotion

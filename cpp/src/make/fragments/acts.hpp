// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "fragments/fragment.hpp"

namespace fragmotion {

/// How many words a clip's name has beside "idle", as stands are called in games: 0 of "Armature|Idle_2", 1 of
/// "SitIdle"; -1 where it has not that.
int words_beside_idle(const std::string& name);

/// Where clips stand whose names hold the word "idle", those of them that are named so by the fewest words are how the
/// body stands: leaves the fragments of all others out of the pool that do nothing but stand. They are acts, as of who
/// waves, shoots, sits or dies, which nobody asks for who lets go of the stick. Needs the fragments' evident controls.
void drop_acts(FragmentPool& pool, const ControlSpace& space);

}  // namespace fragmotion

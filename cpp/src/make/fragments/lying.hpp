// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "fragments/fragment.hpp"

namespace fragmotion {

/// Leaves out of the pool's fragments, from number `first` on, those in which a body on four legs sits or lies, or gets
/// down or up: where its hips or its shoulders are far lower over the ground than they are in the pool's clips when it
/// stands. Else an animal would sit down for a stand. Bodies on two legs keep all.
void drop_lying(FragmentPool& pool, std::size_t first);

}  // namespace fragmotion

// SPDX-License-Identifier: MIT
#pragma once

#include "policy/iterate.hpp"

namespace fragmotion {

/// What every player does with every control, in ten counts: it is kept for another step in 85 of 100, and else
/// anything may follow. A minute of play visits a fifth of the controls; of the others this is all that is known.
constexpr ControlPrior kGenericPrior{8.5, 1.5};

/// The policy that drives unless told otherwise: value_iteration whose control model begins with
/// kGenericPrior, so that what one player never did is foreseen for the others.
Policy anticipate_policy(const Quality& quality, const std::vector<std::vector<int>>& traces);

}  // namespace fragmotion

// SPDX-License-Identifier: MIT
#pragma once

#include "skeleton/body_tree.hpp"

namespace fragmotion {

/// Legs that names tell, as the rest pose corrects them: a foot on which nothing hangs gives way to the bone beside it
/// from which the leg goes on to the toes, one that carries no skin to the one that does, and no shin is told of a leg
/// that has a joint more than a man's.
void mend_named_legs(const Skeleton& skeleton, const BodyTree& tree, BodyJoints& body);

/// Birds, cats and some robots have a joint more than men: what is their shin is not told.
void forget_shins_of_beasts(const Skeleton& skeleton, const BodyTree& tree, BodyJoints& body);

}  // namespace fragmotion

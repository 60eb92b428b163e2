// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "motion/contacts.hpp"

namespace fragmotion {

/// Moves clips up or down onto one floor, the usual_floors() of their contacts, which come along: captured on different
/// days and of different actors, feet stand some centimetres higher in one take than in another, and a body that goes
/// from one to the other sinks in. The foot whose ball or heel stands lowest beside the usual one tells by how much, so
/// that whoever tiptoes or lies is not pushed into the ground; of a body on four legs the balls alone.
void put_on_one_floor(std::vector<Clip>& clips, std::vector<Contacts>& contacts);

}  // namespace fragmotion

// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "doctor/patient.hpp"

namespace fragmotion {

/// The patient's take as a clip on its own skeleton; nothing where it cannot be one.
std::optional<Clip> clip_of(const Patient& patient);

}  // namespace fragmotion

// SPDX-License-Identifier: MIT
#include "doctor/clip_of.hpp"

#include <stdexcept>

namespace fragmotion {

std::optional<Clip> clip_of(const Patient& patient) {
  try {
    check_stature(patient.take().skeleton);
    return clip_from_take(patient.take().skeleton, patient.take());
  } catch (const std::invalid_argument&) {
    return std::nullopt;
  }
}

}  // namespace fragmotion

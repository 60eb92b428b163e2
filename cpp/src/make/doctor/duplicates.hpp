// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <vector>

#include "doctor/patient.hpp"

namespace fragmotion {

/// Head, hands and feet of a pose as the hips see them.
using Shape = std::array<float, 15>;

/// What a motion is told by, wherever it goes, and whatever the body's size and the frame rate.
struct Outline {
  std::vector<Shape> shapes;  ///< 30 a second; none where there are no legs.
  float near = 0;             ///< The squared distance under which two of them are the same.
};

Outline outline_of(const Patient& patient);

/// Appends to each examination what other take has the same motion, though cut or resampled.
void find_duplicates(const std::vector<const Take*>& takes, const std::vector<Outline>& outlines, int threads,
                     const Progress& progress, std::vector<Examination>& told);

}  // namespace fragmotion

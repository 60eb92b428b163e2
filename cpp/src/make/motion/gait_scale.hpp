// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>

namespace fragmotion {

/// By which speeds are those of a character of 1.8 m where they tell whether it moves or walks; lengths are by `scale`.
/// Bodies go alike at speeds that are as the roots of their sizes (R. Alexander and A. Jayes, "A dynamic similarity
/// hypothesis for the gaits of quadrupedal mammals", Journal of Zoology 201, 1983): a giant's walk is slow for its
/// size. Small ones are drawn at any speed.
inline double gait_scale(double scale) { return std::max(scale, std::sqrt(scale)); }

}  // namespace fragmotion

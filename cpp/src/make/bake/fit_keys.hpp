// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

namespace fragmotion {

/// Keys of a curve of `width` components and its values on every frame between them: cubic Hermite segments that share
/// their slope at a key, so that it is smooth.
struct FittedKeys {
  std::vector<int> key_frames;  ///< [keys], ascending; the first and the last frame are keys.
  std::vector<double> slopes;   ///< [keys, width], a frame.
  std::vector<double> drawn;    ///< [frames, width]
};

/// Few keys whose curve passes all of `values` [frames, width] within a distance of `tolerance`: keys are put where the
/// curve is furthest off until none is (Schneider, "An algorithm for automatically fitting digitized curves", Graphics
/// Gems 1990), slopes are those of least squares over all frames. A key has its frame's value. Throws
/// std::invalid_argument without a frame or a component, on what is not finite, and on a tolerance that is not
/// positive.
FittedKeys fit_keys(const std::vector<double>& values, int width, double tolerance);

}  // namespace fragmotion

// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace fragmotion {

/// What an animator has marked in a take for the game to know: a sound, an effect.
struct Marker {
  std::string name;  ///< UTF-8, not empty.
  double frame = 0;  ///< Of the clip, from 0; may be between two.
};

/// Throws std::invalid_argument unless each has a name and lies within so many frames, none before the one before it.
void check_markers(const std::vector<Marker>& markers, int frames);

/// Those within a clip's frames begin .. begin + length - 1, in each round of a clip of so many frames that shows these
/// again and again.
std::vector<Marker> markers_in_rounds(const std::vector<Marker>& markers, int begin, int length, int frames);

}  // namespace fragmotion

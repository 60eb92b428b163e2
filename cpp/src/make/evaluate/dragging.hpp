// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "evaluate/body_track.hpp"
#include "evaluate/foot_clearance.hpp"

namespace fragmotion {

/// How far the balls of feet go along the ground, m of a 1.8 m character, and how much of it lower than those of the
/// takes that are as fast.
struct Dragging {
  double way = 0, dragged = 0;

  void add(const Dragging& other);
  double share() const { return way > 0 ? dragged / way : 0; }
};

/// Of the feet of takes that stand on their floors: m/s and m of a 1.8 m character.
FootClearance clearance_of(const std::vector<BodyTrack>& takes);

/// From frame `first` on.
Dragging dragging(const BodyTrack& track, const FootClearance& takes, int first = 0);

}  // namespace fragmotion

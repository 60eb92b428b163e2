// SPDX-License-Identifier: MIT
#pragma once

#include "evaluate/body_track.hpp"

namespace fragmotion {

/// The steps of a body that goes: how many feet come down, of which it is the foot that came down last, and of which it
/// is the other foot less than 0.2 s after the last.
struct Footfalls {
  int count = 0, same_foot = 0, quick = 0;

  void add(const Footfalls& other);
};

/// Of all footfalls but the first, those since whose predecessor the hips have gone faster than 0.5 m/s, by the
/// straight line that fits the half second around each frame best. None without feet.
Footfalls count_footfalls(const BodyTrack& track);

}  // namespace fragmotion

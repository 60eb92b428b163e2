// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

#include "evaluate/body_track.hpp"

namespace fragmotion {

/// A body of a few points at 60 frames a second: feet side by side on the ground, 0.2 m apart, balls 0.15 m ahead of
/// the heels, which face +y; its centre of mass and its hips 0.95 m above.
inline BodyTrack standing_track(double seconds) {
  BodyTrack track;
  track.rate = 60;
  for (int f = 0; f <= std::lround(seconds * track.rate); ++f) {
    track.center.emplace_back(0, 0, 0.95);
    track.hips.emplace_back(0, 0, 0.95);
    track.heading.push_back(0);
    for (int side = 0; side < 2; ++side) {
      const double x = side == 0 ? -0.1 : 0.1;
      track.feet[side].ball.emplace_back(x, 0.1, 0);
      track.feet[side].heel.emplace_back(x, -0.05, 0);
      track.stands[side].push_back(true);
    }
  }
  return track;
}

/// Moves a body, `carries_feet` with its feet, by the path of a time in s, m.
template <typename Path>
void move(BodyTrack& track, bool carries_feet, const Path& path) {
  for (int f = 0; f < track.frames(); ++f) {
    const Vector3 by = path(f / track.rate);
    track.center[f] += by;
    track.hips[f] += by;
    if (!carries_feet) continue;
    for (FootPath& foot : track.feet) {
      foot.ball[f] += by;
      foot.heel[f] += by;
    }
  }
}

}  // namespace fragmotion

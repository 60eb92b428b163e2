// SPDX-License-Identifier: MIT
#pragma once

#include "fragmotion/evaluate/body_track.hpp"

namespace fragmotion {

/// Frames whose acceleration is known, and those of them in which nothing under the body can give it.
struct Support {
  int judged = 0, unsupported = 0;

  /// NaN where none is judged.
  double unsupported_share() const;
  void add(const Support& other);
};

/// Whether the ground can give the acceleration of the centre of mass, which is that of the parabola that fits the
/// fifth of a second around a frame best. On feet that stand at any time of that fifth it cannot where the zero-moment
/// point of a body whose mass is at its centre, c - (a_x, a_y) height / (a_z + g), is more than 0.27 m, a foot's
/// length, outside the convex hull of their balls and heels, and where it pulls: a_z + g < -3 m/s^2. Where none stands,
/// balls and heels within 4.5 cm of their floor count as standing; where there are none either, the body is in the air,
/// and any acceleration further than 3 m/s^2 from falling is unsupported. Nothing is judged without feet, or nearer
/// than a tenth of a second to an end.
Support find_support(const BodyTrack& track);

}  // namespace fragmotion

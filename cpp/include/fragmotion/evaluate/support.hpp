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

/// Whether the ground can give the acceleration (a_x, a_y, a_z) of the centre of mass c, which is that of the parabola
/// that fits the quarter of a second around a frame best. It can where the body all but falls, within 3 m/s^2; and on
/// feet that stand at any time of that quarter where it pushes, a_z > -g, and the zero-moment point of a body whose
/// mass is at its centre, c - (a_x, a_y) height / (a_z + g), is no more than 0.27 m, a foot's length, outside the
/// convex hull of their balls and heels. Where none stands, balls and heels within 4.5 cm of their floor count as
/// standing; where there are none either, the body is in the air. Nothing is judged without feet, or within an eighth
/// of a second of an end.
Support find_support(const BodyTrack& track);

}  // namespace fragmotion

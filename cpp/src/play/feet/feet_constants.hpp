// SPDX-License-Identifier: MIT
#pragma once

namespace fragmotion {

/// Of feet that are held where they stand (foot_lock.hpp). Lengths are those of a character of 1.8 m.
struct FeetConstants {
  double release = 0.33;  ///< s in which a foot that is let go gets back to its motion, most of the way; both feet
                          ///< stand as long before one steps to where its motion has it.
  double rests = 0.02;    ///< s: time constant of a foot that comes to rest.
  double sinks = 0.1;     ///< s: time constant of hips that sink for a leg that is too short.
  double too_far = 0.3;   ///< m from its motion at which a foot is let go,
  double alone = 0.5;     ///< m, and at which the only one that stands is.
  double strained = 0.1;  ///< m that hips would have to sink for a foot: from there it steps on.
  double astray = 0.07;   ///< m from its motion at least, for a foot to step there rather than slide.
  double step = 0.04;     ///< m: how high it steps.
  double hovers = 0.015;  ///< m over the floor, from where a planted foot is lowered.
  double ahead = 0.15;    ///< Of what balances an acceleration: so far behind or ahead of the hips feet are set for it.

  /// 1/s: of a foot that is let go, which is critically damped.
  double returns() const { return 3.5 / release; }
};

}  // namespace fragmotion

// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "motion/foot_paths.hpp"
#include "retarget/body.hpp"

namespace fragmotion {

/// The least and the greatest bend of a knee, rad.
struct KneeRange {
  double least = kPi, most = 0;

  void add(double bend) {
    least = std::min(least, bend);
    most = std::max(most, bend);
  }
};

/// Of a leg in a pose: how far its knee is bent, rad, and how far its ends may be apart for it to bend that far, m.
double knee_bend(const Leg& leg, const PosedBones& posed);
Reach reach_of(const Leg& leg, const PosedBones& posed, const KneeRange& range);

/// What the legs do in a clip.
struct LegMotion {
  FootPaths paths;
  std::array<KneeRange, 2> knees;

  LegMotion(const Body& body, const Clip& clip);
};

/// For each frame the heading, rad, that a body had while a foot stood: held as long as it stands, and going over to
/// the next while it does not. `headings`: the body's.
std::vector<double> held_headings(const std::vector<bool>& stands, const std::vector<double>& headings);

/// How far hips are to be moved up in each frame, smoothly, for them to be between `least` and `most` (which counts
/// more), m.
std::vector<double> smooth_moves(const std::vector<double>& least, const std::vector<double>& most, double rate);

}  // namespace fragmotion

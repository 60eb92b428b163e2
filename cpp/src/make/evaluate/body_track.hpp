// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <vector>

#include "motion/clip.hpp"
#include "motion/foot_paths.hpp"

namespace fragmotion {

/// A motion as what its weight is judged by: a few points of the body a frame, in lengths of a 1.8 m character.
struct BodyTrack {
  double rate = 0;                                  ///< Frames a second.
  std::vector<Vector3> center, hips;                ///< [frames] m: the centre of mass, and the hips' head.
  std::vector<double> heading;                      ///< [frames] rad, unwrapped: facing().
  FootPaths feet;                                   ///< [frames] m; empty where the skeleton has no feet
  Floors floors;                                    ///< m: where ball and heel stand
  std::array<std::vector<bool>, kMostLegs> stands;  ///< [frames], as find_contacts() tells it; empty without feet

  int frames() const { return static_cast<int>(center.size()); }
  bool has_feet() const { return feet.count() > 0; }
  /// The frames that so many seconds are, at least 1.
  int frames_in(double seconds) const;
};

/// The track of a clip, whose feet stand on no floor yet.
BodyTrack body_track(const Kinematics& kinematics, const Clip& clip);

/// Tells where the feet stand on floors whose heights are in m of a 1.8 m character.
void stand_on(BodyTrack& track, const Floors& floors);

/// [frames - 2 * 0.2 s]: the change over 0.2 s of a place's mean velocity over 0.2 s, m/s^2, along the ground.
std::vector<double> ground_accelerations(const std::vector<Vector3>& path, double rate);

/// [frames - 2 * 0.2 s]: likewise of an angle, rad/s^2, without its sign.
std::vector<double> angular_accelerations(const std::vector<double>& angles, double rate);

}  // namespace fragmotion

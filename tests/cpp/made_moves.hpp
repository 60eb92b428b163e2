// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "build/moves.hpp"
#include "motion/pose.hpp"
#include "small_character.hpp"

namespace fragmotion {

/// Half a second there and half a second back: 0 at both ends, 1 between.
inline double up_and_down(double seconds, double length) {
  return ease_in_ease_out(seconds / 0.5) * ease_in_ease_out((length - seconds) / 0.5);
}

/// A humanoid() that stands and waves with its right arm.
inline Clip wave_clip(double seconds = 2) {
  Gait stand;
  stand.y = 0;
  stand.seconds = seconds;
  Clip clip = gait_clip(stand, "wave");
  const int arm = humanoid().find("upper_arm.R");
  for (int f = 0; f < clip.frames; ++f) {
    const double t = f / clip.rate, angle = up_and_down(t, seconds) * (2.4 + 0.3 * std::sin(8 * t));
    store_quaternion(Quaternion{Eigen::AngleAxisd(angle, Vector3::UnitY())},
                     &clip.rotations[std::size_t{4} * (f * humanoid().size() + arm)]);
  }
  return clip;
}

/// A humanoid() that bows and rises, and is shifted meanwhile by `way` m ahead and turned by `turn` rad.
inline Clip lunge_clip(double way = 0.6, double turn = 0.8, double seconds = 1.5) {
  Gait stand;
  stand.y = 0;
  stand.seconds = seconds;
  const Clip still = gait_clip(stand, "lunge");
  Clip clip = still;
  for (int f = 0; f < clip.frames; ++f) {
    const double t = f / clip.rate, part = ease_in_ease_out(t / seconds), angle = turn * part;
    clip.root_positions[std::size_t{3} * f + 1] += way * part;
    double* pose = &clip.rotations[std::size_t{4} * f * humanoid().size()];
    store_quaternion(CharacterFrame{{0, 0}, angle}.rotation() * load_quaternion(pose), pose);
    store_quaternion(Quaternion{Eigen::AngleAxisd(up_and_down(t, seconds), Vector3::UnitX())}, pose + 4);
  }
  clip.headings.clear();
  return make_clip(humanoid(), clip);
}

/// gait_character() with a lunge, one that loops in its middle, a wave of the upper body, and one that loops.
inline std::shared_ptr<const Character> moving_character() {
  static const auto character = std::make_shared<const Character>(
      with_moves(*gait_character(), {{"lunge", lunge_clip(), false, 0.5, {}},
                                     {"long lunge", lunge_clip(), false, 0.5, {0.5, 1}},
                                     {"wave", wave_clip(), true, 0.5, {}},
                                     {"long wave", wave_clip(), true, 0.5, {0.6, 1.4}}}));
  return character;
}

}  // namespace fragmotion

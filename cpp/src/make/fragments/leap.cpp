// SPDX-License-Identifier: MIT
#include "fragments/leap.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace fragmotion {

Leap leap_of(const Kinematics& kinematics, Clip clip, const Hop& hop, double usual, const ControlSpace& space) {
  const auto frame = [&](double seconds) { return static_cast<int>(std::lround(seconds * clip.rate)); };
  const int begin = frame(hop.crouch()), end = frame(hop.crouch() + hop.flight());
  BodyMotion motion = body_motion(kinematics, clip);
  motion.in_gait.assign(clip.frames, false);
  const Control evident = evident_control(motion, clip.rate, begin, end, usual, space);
  return {std::move(clip), std::move(motion), begin, end, evident};
}

void fly_as_fast(const Control& control, Leap& leap) {
  const Eigen::Rotation2Dd halfway(0.5 * (leap.motion.heading[leap.begin] + leap.motion.heading[leap.end]));
  const Vector2 missing = halfway * Vector2(control.x - leap.evident.x, control.y - leap.evident.y) / leap.clip.rate;
  for (int f = leap.begin + 1; f < leap.clip.frames; ++f) {
    const Vector2 further = (std::min(f, leap.end) - leap.begin) * missing;
    Eigen::Map<Vector2>(&leap.clip.root_positions[std::size_t{3} * f]) += further;
    leap.motion.center[f].head<2>() += further;
  }
  leap.evident.x = control.x;
  leap.evident.y = control.y;
}

}  // namespace fragmotion

// SPDX-License-Identifier: MIT
#include "fragmotion/evident.hpp"

#include <algorithm>
#include <cmath>

namespace fragmotion {
namespace {

constexpr double kNoRise = 0.08, kRise = 0.2;  // m of a 1.8 m character

}  // namespace

BodyMotion body_motion(const Kinematics& kinematics, const Clip& clip) {
  return {center_of_mass(kinematics, clip), clip.headings};
}

double usual_height(const std::vector<BodyMotion>& motions) {
  std::vector<double> heights;
  for (const BodyMotion& motion : motions) {
    for (const Vector3& center : motion.center) heights.push_back(center.z());
  }
  if (heights.empty()) return 0;
  std::nth_element(heights.begin(), heights.begin() + heights.size() / 2, heights.end());
  return heights[heights.size() / 2];
}

Control evident_control(const BodyMotion& motion, double rate, int begin, int end, double usual,
                        const ControlSpace& space) {
  const double seconds = (end - begin) / rate;
  const CharacterFrame halfway{Vector2::Zero(), 0.5 * (motion.heading[begin] + motion.heading[end])};
  const Vector3 velocity = halfway.to_local((motion.center[end] - motion.center[begin]) / seconds);
  double rise = 0;
  for (int f = begin; f <= end; ++f) rise = std::max(rise, (motion.center[f].z() - usual) * space.scale());
  Control control;
  control.x = velocity.x();
  control.y = velocity.y();
  control.turn = (motion.heading[end] - motion.heading[begin]) / seconds / space.turn_rate();
  control.jump = std::clamp((rise - kNoRise) / (kRise - kNoRise), 0.0, 1.0);
  return control;
}

}  // namespace fragmotion

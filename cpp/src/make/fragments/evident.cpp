// SPDX-License-Identifier: MIT
#include "fragments/evident.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/quantile.hpp"
#include "fragments/whole_jumps.hpp"
#include "motion/gait_bounces.hpp"

namespace fragmotion {
namespace {

constexpr double kNoRise = 0.08;   // m of a 1.8 m character
constexpr double kTakesOff = 0.4;  // evident jump of what only leads into a jump, or out of it

double evident_jump(double rise) { return std::clamp((rise - kNoRise) / (kJumpRise - kNoRise), 0.0, 1.0); }

}  // namespace

double missing_rise(double jump) { return (1 - jump) * (kJumpRise - kNoRise); }

BodyMotion body_motion(const Kinematics& kinematics, const Clip& clip) {
  std::vector<Vector3> center = center_of_mass(kinematics, clip);
  std::vector<bool> in_gait = gait_bounces(kinematics, clip, center);
  return {std::move(center), clip.headings, std::move(in_gait)};
}

double usual_height(const std::vector<BodyMotion>& motions) {
  std::vector<double> heights;
  for (const BodyMotion& motion : motions) {
    for (const Vector3& center : motion.center) heights.push_back(center.z());
  }
  return heights.empty() ? 0 : median(std::move(heights));
}

Control evident_control(const BodyMotion& motion, double rate, int begin, int end, double usual,
                        const ControlSpace& space) {
  const double seconds = (end - begin) / rate;
  const CharacterFrame halfway{Vector2::Zero(), 0.5 * (motion.heading[begin] + motion.heading[end])};
  const Vector3 velocity = halfway.to_local((motion.center[end] - motion.center[begin]) / seconds);
  double rise = 0, flight = 0;  // m: how high it is, and how high it would fly, or flew
  for (int f = begin; f <= end; ++f) {
    if (motion.in_gait[f]) continue;
    const double height = (motion.center[f].z() - usual) * space.scale();
    rise = std::max(rise, height);
    if (f == end) break;
    const double next = (motion.center[f + 1].z() - usual) * space.scale(), speed = (next - height) * rate;
    flight = std::max(flight, (height + next) / 2 + speed * speed / (2 * kGravity));
  }
  Control control;
  control.x = velocity.x();
  control.y = velocity.y();
  control.turn = (motion.heading[end] - motion.heading[begin]) / seconds / space.turn_rate();
  control.jump = std::max(evident_jump(rise), kTakesOff * evident_jump(flight));
  return control;
}

void lead_to_jumps(FragmentPool& pool) {
  find_whole_jumps(pool);
  for (const Fragment& jump : pool.fragments) {
    if (!jump.evident.jumps()) continue;
    for (Fragment& f : pool.fragments) {
      const int of_it = std::min(f.end, jump.last_played()) - std::max(f.begin, jump.first_played());
      const bool leads = f.clip == jump.clip && 2 * of_it > f.end - f.begin;
      if (leads) f.evident.jump = std::max(f.evident.jump, kTakesOff);
    }
  }
}

}  // namespace fragmotion

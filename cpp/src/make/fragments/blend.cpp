// SPDX-License-Identifier: MIT
#include "fragments/blend.hpp"

#include <algorithm>
#include <cmath>

#include "fragments/body_pose.hpp"
#include "motion/pose.hpp"

namespace fragmotion {

Clip interpolated(const Kinematics& kinematics, const FragmentPool& pool, const Fragment& a, const Fragment& b,
                  double w, int tail) {
  const Clip &clip_a = pool.clips[a.clip], &clip_b = pool.clips[b.clip];
  const double seconds = (1 - w) * pool.seconds(a) + w * pool.seconds(b);
  const int shortest = static_cast<int>(std::ceil(kShortestFragment * clip_a.rate - 1e-6));
  const int end = std::max({1, shortest, static_cast<int>(std::lround(seconds * clip_a.rate))});
  const CharacterFrame start_a = frame_at(clip_a, a.begin), start_b = frame_at(clip_b, b.begin);
  Clip result;
  result.name = clip_a.name + " + " + clip_b.name;
  result.rate = clip_a.rate;
  for (int f = 0; f <= end + tail; ++f) {
    const double phase = static_cast<double>(f) / end;
    BodyPose pose = body_pose(kinematics, clip_a, a.begin + phase * (a.end - a.begin));
    const BodyPose other = body_pose(kinematics, clip_b, b.begin + phase * (b.end - b.begin));
    blend_rotations(pose.rotations.data(), other.rotations.data(), w, kinematics.bones(), pose.rotations.data());
    pose.height += w * (other.height - pose.height);
    const auto moved = [](const CharacterFrame& start, const CharacterFrame& now) {
      return turned(now.position - start.position, -start.heading);
    };
    const auto headed = [](const CharacterFrame& start, const CharacterFrame& now) {
      return now.heading - start.heading;
    };
    append(kinematics, result,
           {(1 - w) * moved(start_a, pose.frame) + w * moved(start_b, other.frame),
            (1 - w) * headed(start_a, pose.frame) + w * headed(start_b, other.frame)},
           pose);
  }
  return result;
}

}  // namespace fragmotion

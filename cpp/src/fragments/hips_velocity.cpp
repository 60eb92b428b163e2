// SPDX-License-Identifier: MIT
#include "fragmotion/fragments/hips_velocity.hpp"

#include <algorithm>
#include <cmath>

#include "fragmotion/motion/pose.hpp"

namespace fragmotion {
namespace {

constexpr double kEnd = 0.1;  // s
constexpr int kMoments = 8;

Vector2 velocity_between(const PackedClip& clip, double begin, double end) {
  const CharacterFrame from = frame_at(clip, begin), to = frame_at(clip, end);
  const double heading = from.heading + std::remainder(to.heading - from.heading, 2 * kPi) / 2;
  return Eigen::Rotation2Dd(-heading) * (to.position - from.position) * (clip.rate / (end - begin));
}

}  // namespace

Vector2 hips_velocity(const PackedClip& clip, const Fragment& fragment) {
  return velocity_between(clip, fragment.begin, fragment.end);
}

Vector2 hips_velocity_around(const PackedClip& clip, double frame, double seconds) {
  const double half = seconds * clip.rate / 2, last = clip.frames - 1, middle = std::clamp(frame, 0.0, last);
  return velocity_between(clip, std::max(0.0, middle - half), std::min(last, middle + half));
}

Vector2 mean_velocity_around(const PackedClip& clip, const Fragment& fragment, double seconds) {
  Vector2 sum = Vector2::Zero();
  for (int moment = 0; moment < kMoments; ++moment) {
    const double frame = fragment.begin + (moment + 0.5) / kMoments * (fragment.end - fragment.begin);
    sum += hips_velocity_around(clip, frame, seconds);
  }
  return sum / kMoments;
}

std::vector<double> velocity_changes(const PackedPool& pool) {
  const double scale = standard_scale(pool.skeleton);
  std::vector<double> changes;
  for (const Fragment& f : pool.fragments) {
    const PackedClip& clip = pool.clips[f.clip];
    const double first = f.first_played(), last = f.last_played(), end = std::min(kEnd * clip.rate, last - first);
    changes.push_back(scale *
                      (velocity_between(clip, last - end, last) - velocity_between(clip, first, first + end)).norm());
  }
  return changes;
}

}  // namespace fragmotion

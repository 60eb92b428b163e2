// SPDX-License-Identifier: MIT
#include "fragments/hips_velocity.hpp"

#include <algorithm>
#include <cmath>

#include "fragments/entry_poses.hpp"
#include "motion/pose.hpp"

namespace fragmotion {
namespace {

constexpr int kMoments = 8;

Travel travel_between(const PackedClip& clip, double begin, double end) {
  const CharacterFrame from = frame_at(clip, begin), to = frame_at(clip, end);
  const double angle = wrapped(to.heading - from.heading), rate = clip.rate / (end - begin);
  return {PlaneTurn(-from.heading - angle / 2) * (to.position - from.position) * rate, angle * rate};
}

Vector2 velocity_between(const PackedClip& clip, double begin, double end) {
  return travel_between(clip, begin, end).velocity;
}

}  // namespace

Vector2 hips_velocity(const PackedClip& clip, const Fragment& fragment) {
  return velocity_between(clip, fragment.begin, fragment.end);
}

Travel travel_around(const PackedClip& clip, double frame, double seconds) {
  const double half = seconds * clip.rate / 2, last = clip.frames - 1, middle = std::clamp(frame, 0.0, last);
  return travel_between(clip, std::max(0.0, middle - half), std::min(last, middle + half));
}

Vector2 hips_velocity_around(const PackedClip& clip, double frame, double seconds) {
  return travel_around(clip, frame, seconds).velocity;
}

Vector2 mean_velocity_around(const PackedClip& clip, const Fragment& fragment, double seconds) {
  Vector2 sum = Vector2::Zero();
  for (int moment = 0; moment < kMoments; ++moment) {
    const double frame = fragment.begin + (moment + 0.5) / kMoments * (fragment.end - fragment.begin);
    sum += hips_velocity_around(clip, frame, seconds);
  }
  return sum / kMoments;
}

std::vector<EndVelocities> end_velocities(const PackedPool& pool) {
  std::vector<EndVelocities> all;
  for (const Fragment& f : pool.fragments) {
    const PackedClip& clip = pool.clips[f.clip];
    const double first = f.first_played(), last = f.last_played(), end = std::min(kEntry * clip.rate, last - first);
    all.push_back({velocity_between(clip, first, first + end), velocity_between(clip, last - end, last)});
  }
  return all;
}

}  // namespace fragmotion

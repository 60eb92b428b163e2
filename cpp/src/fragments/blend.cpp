// SPDX-License-Identifier: MIT
#include "fragmotion/fragments/blend.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "fragments/body_pose.hpp"
#include "fragmotion/motion/pose.hpp"

namespace fragmotion {
namespace {

double lowest_tip(const Kinematics& kinematics, const Clip& clip, int frame) {
  std::vector<Vector3> heads(kinematics.bones());
  std::vector<Quaternion> orientations(kinematics.bones());
  world(kinematics, clip, frame, heads.data(), orientations.data());
  double lowest = std::numeric_limits<double>::infinity();
  for (const int b : measured_bones(kinematics.skeleton())) {
    lowest = std::min(lowest, (heads[b] + orientations[b] * kinematics.skeleton().tips[b]).z());
  }
  return lowest;
}

void add_to_mean(BodyPose& mean, const BodyPose& pose) {
  mean.height += pose.height;
  if (mean.rotations.empty()) mean.rotations.resize(pose.rotations.size(), 0);
  for (std::size_t b = 0; b < pose.rotations.size(); b += 4) add_rotation(&pose.rotations[b], &mean.rotations[b]);
}

}  // namespace

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

Clip standing(const Kinematics& kinematics, const FragmentPool& pool, int frames, double rate) {
  std::vector<int> slowest(pool.fragments.size());
  for (std::size_t i = 0; i < slowest.size(); ++i) slowest[i] = static_cast<int>(i);
  std::stable_sort(slowest.begin(), slowest.end(),
                   [&](int a, int b) { return pool.fragments[a].evident.speed() < pool.fragments[b].evident.speed(); });
  slowest.resize(std::min(slowest.size(), std::max<std::size_t>(10, slowest.size() / 5)));
  BodyPose mean;
  double floor = 0, count = 0;
  for (const int i : slowest) {
    const Fragment& fragment = pool.fragments[i];
    for (int f = fragment.begin; f < fragment.end; ++f) {
      add_to_mean(mean, body_pose(kinematics, pool.clips[fragment.clip], f));
      floor += lowest_tip(kinematics, pool.clips[fragment.clip], f);
      ++count;
    }
  }
  for (int b = 0; b < 4 * kinematics.bones(); b += 4) {
    store_quaternion(load_quaternion(&mean.rotations[b]).normalized(), &mean.rotations[b]);
  }
  mean.height /= count;
  Clip clip;
  clip.name = "standing";
  clip.rate = rate;
  append(kinematics, clip, {}, mean);
  mean.height += floor / count - lowest_tip(kinematics, clip, 0);
  clip.root_positions[2] = mean.height;
  while (clip.frames < frames) append(kinematics, clip, {}, mean);
  return clip;
}

}  // namespace fragmotion

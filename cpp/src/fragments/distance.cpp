// SPDX-License-Identifier: MIT
#include "fragmotion/fragments/distance.hpp"

#include <cmath>
#include <stdexcept>
#include <string>

#include "base/vectorised.hpp"
#include "fragmotion/base/parallel.hpp"
#include "fragmotion/motion/pose.hpp"

namespace fragmotion {

BodyTips::BodyTips(const Skeleton& skeleton)
    : kinematics_(skeleton),
      bones_(measured_bones(skeleton)),
      scale_(standard_scale(skeleton)),
      posed_(skeleton.size()) {}

void BodyTips::pose(const Vector3& root, const double* rotations) {
  kinematics_.world(root, rotations, posed_.heads.data(), posed_.rotations.data());
}

void BodyTips::write(const CharacterFrame& frame, float* rows, int stride, int offset) const {
  const double c = scale_ * std::cos(frame.heading), s = scale_ * std::sin(frame.heading);
  float *to_x = rows + offset, *to_y = to_x + stride, *to_z = to_y + stride;
  for (int i = 0; i < points(); ++i) {
    const int b = bones_[i];
    const Vector3 tip = posed_.heads[b] + posed_.rotations[b] * kinematics_.skeleton().tips[b];
    const double x = tip.x() - frame.position.x(), y = tip.y() - frame.position.y();
    to_x[i] = static_cast<float>(c * x + s * y);
    to_y[i] = static_cast<float>(c * y - s * x);
    to_z[i] = static_cast<float>(scale_ * tip.z());
  }
}

// Eight partial sums make the order of additions, and so the bits, the same with any instructions.
FRAGMOTION_VECTORISED float tip_distance(const float* a, const float* b, int stride) {
  float sums[kLanes] = {};
  for (int i = 0; i < stride; i += kLanes) {
    for (int lane = 0; lane < kLanes; ++lane) {
      const int x = i + lane, y = x + stride, z = y + stride;
      const float dx = a[x] - b[x], dy = a[y] - b[y], dz = a[z] - b[z];
      sums[lane] += std::sqrt(dx * dx + dy * dy + dz * dz);
    }
  }
  return ((sums[0] + sums[1]) + (sums[2] + sums[3])) + ((sums[4] + sums[5]) + (sums[6] + sums[7]));
}

template <typename AnyClip>
Trajectories trajectories(const Pool<AnyClip>& pool, int poses, int threads) {
  if (poses < 2 || poses > kMostPoses) {
    throw std::invalid_argument("a trajectory has 2 to " + std::to_string(kMostPoses) + " poses, not " +
                                std::to_string(poses));
  }
  const int points = BodyTips(pool.skeleton).points();
  Trajectories t;
  t.count = static_cast<int>(pool.fragments.size());
  t.tips = points;
  t.stride = padded(points * poses);
  t.pose_stride = padded(points);
  t.whole.assign(static_cast<std::size_t>(t.count) * 3 * t.stride, 0);
  t.first.assign(static_cast<std::size_t>(t.count) * 3 * t.pose_stride, 0);
  t.last = t.first;
  parallel_for(t.count, thread_count(threads), [&](int begin, int end) {
    BodyTips tips(pool.skeleton);
    std::vector<double> rotations(std::size_t{4} * pool.skeleton.size());
    const auto sample = [&](const AnyClip& clip, double frame) {
      tips.pose(sample_pose(clip, frame, rotations.data()), rotations.data());
      return frame_at(clip, frame);
    };
    for (int i = begin; i < end; ++i) {
      const Fragment& f = pool.fragments[i];
      const AnyClip& clip = pool.clips[f.clip];
      CharacterFrame start;
      for (int pose = 0; pose < poses; ++pose) {
        const double at = f.begin + (f.end - f.begin) * static_cast<double>(pose) / (poses - 1);
        const CharacterFrame frame = sample(clip, at);
        if (pose == 0) {
          start = frame;
          tips.write(frame, &t.first[static_cast<std::size_t>(i) * 3 * t.pose_stride], t.pose_stride, 0);
        }
        tips.write(start, &t.whole[static_cast<std::size_t>(i) * 3 * t.stride], t.stride, pose * points);
        if (pose == poses - 1) {
          tips.write(frame, &t.last[static_cast<std::size_t>(i) * 3 * t.pose_stride], t.pose_stride, 0);
        }
      }
    }
  });
  return t;
}

template Trajectories trajectories(const FragmentPool& pool, int poses, int threads);
template Trajectories trajectories(const PackedPool& pool, int poses, int threads);

std::vector<float> openings(const PackedPool& pool, int threads) {
  const int points = BodyTips(pool.skeleton).points(), stride = padded(2 * points);
  std::vector<float> openings(pool.fragments.size() * 3 * stride, 0);
  parallel_for(static_cast<int>(pool.fragments.size()), thread_count(threads), [&](int begin, int end) {
    BodyTips tips(pool.skeleton);
    std::vector<double> rotations(std::size_t{4} * pool.skeleton.size());
    for (int i = begin; i < end; ++i) {
      const Fragment& f = pool.fragments[i];
      const PackedClip& clip = pool.clips[f.clip];
      for (int later = 0; later < 2; ++later) {
        tips.pose(sample_pose(clip, f.begin + later * kOpening * clip.rate, rotations.data()), rotations.data());
        tips.write(frame_at(clip, f.begin), &openings[static_cast<std::size_t>(i) * 3 * stride], stride,
                   later * points);
      }
    }
  });
  return openings;
}

float fragment_distance(const Trajectories& t, int f, int g) {
  return tip_distance(t.trajectory(f), t.trajectory(g), t.stride);
}

float transition_distance(const Trajectories& t, int f, int g) {
  return tip_distance(t.last_pose(f), t.first_pose(g), t.pose_stride);
}

}  // namespace fragmotion

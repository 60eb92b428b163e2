// SPDX-License-Identifier: MIT
#include "fragments/distance.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>

#include "base/parallel.hpp"
#include "motion/pose.hpp"

namespace fragmotion {

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
  t.reach = tip_reach(pool.skeleton);
  t.whole = TipRows(t.count, points * poses);
  t.pose_stride = padded(points);
  t.first.assign(static_cast<std::size_t>(t.count) * 3 * t.pose_stride, 0);
  t.last = t.first;
  parallel_for(t.count, thread_count(threads), [&](int begin, int end) {
    TipWriter tips(pool.skeleton);
    std::array<std::vector<float>, TipWriter::kPoses> rows;  // of as many fragments, whose poses are whole batches
    for (std::vector<float>& each : rows) each.resize(t.whole.width());
    const auto add = [&](int i, float* whole) {
      const Fragment& f = pool.fragments[i];
      const AnyClip& clip = pool.clips[f.clip];
      const CharacterFrame start = frame_at(clip, f.begin);
      for (int pose = 0; pose < poses; ++pose) {
        const double at = f.begin + (f.end - f.begin) * static_cast<double>(pose) / (poses - 1);
        tips.add(sample_pose(clip, at, tips.rotations()), start, whole, t.whole.stride(), pose * points);
      }
      const auto end_pose = [&](int at, std::vector<float>& poses_at) {
        float* pose = &poses_at[static_cast<std::size_t>(i) * 3 * t.pose_stride];
        tips.add(sample_pose(clip, at, tips.rotations()), frame_at(clip, at), pose, t.pose_stride, 0);
      };
      end_pose(f.first_played(), t.first);
      end_pose(f.last_played(), t.last);
    };
    for (int from = begin; from < end; from += TipWriter::kPoses) {
      const int to = std::min(from + TipWriter::kPoses, end);
      for (int i = from; i < to; ++i) add(i, rows[i - from].data());
      tips.flush();
      for (int i = from; i < to; ++i) t.whole.set(i, rows[i - from].data());
    }
  });
  return t;
}

template Trajectories trajectories(const FragmentPool& pool, int poses, int threads);
template Trajectories trajectories(const PackedPool& pool, int poses, int threads);

float fragment_distance(const Trajectories& t, int f, int g) { return t.whole.distance(f, t.whole.read(g).data()); }

float transition_distance(const Trajectories& t, int f, int g) {
  return tip_distance(t.last_pose(f), t.first_pose(g), t.pose_stride);
}

}  // namespace fragmotion

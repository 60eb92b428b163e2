// SPDX-License-Identifier: MIT
#include "fragments/distance.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>
#include <utility>

#include "base/parallel.hpp"
#include "motion/pose.hpp"

namespace fragmotion {

namespace {

template <typename AnyClip>
void add_pose(const AnyClip& clip, double at, const CharacterFrame& frame, TipWriter& tips, float* rows, int stride,
              int offset) {
  tips.add(sample_pose(clip, at, tips.rotations()), frame, rows, stride, offset);
}

// Fills the trajectories of the fragments from `first` on.
template <typename AnyClip>
void fill_whole(const Pool<AnyClip>& pool, int poses, int threads, int first, Trajectories& t) {
  parallel_for(t.count - first, threads, [&](int begin, int end) {
    TipWriter tips(pool.skeleton);
    std::array<std::vector<float>, TipWriter::kPoses> rows;  // of as many fragments, whose poses are whole batches
    for (std::vector<float>& each : rows) each.resize(t.whole.width());
    const auto add = [&](const Fragment& f, float* whole) {
      const AnyClip& clip = pool.clips[f.clip];
      const CharacterFrame start = frame_at(clip, f.begin);
      for (int pose = 0; pose < poses; ++pose) {
        const double at = f.begin + (f.end - f.begin) * static_cast<double>(pose) / (poses - 1);
        add_pose(clip, at, start, tips, whole, t.whole.stride(), pose * t.tips);
      }
    };
    for (int from = first + begin; from < first + end; from += TipWriter::kPoses) {
      const int to = std::min(from + TipWriter::kPoses, first + end);
      for (int i = from; i < to; ++i) add(pool.fragments[i], rows[i - from].data());
      tips.flush();
      for (int i = from; i < to; ++i) t.whole.set(i, rows[i - from].data());
    }
  });
}

template <typename AnyClip>
void fill_ends(const Pool<AnyClip>& pool, int threads, Trajectories& t) {
  const std::size_t width = std::size_t{3} * t.pose_stride;
  t.first.assign(width * t.count, 0);
  t.last = t.first;
  parallel_for(t.count, threads, [&](int begin, int end) {
    TipWriter tips(pool.skeleton);
    for (int i = begin; i < end; ++i) {
      const Fragment& f = pool.fragments[i];
      const AnyClip& clip = pool.clips[f.clip];
      const int first = f.first_played(), last = f.last_played();
      add_pose(clip, first, frame_at(clip, first), tips, &t.first[width * i], t.pose_stride, 0);
      add_pose(clip, last, frame_at(clip, last), tips, &t.last[width * i], t.pose_stride, 0);
    }
    tips.flush();
  });
}

}  // namespace

template <typename AnyClip>
Trajectories trajectories(const Pool<AnyClip>& pool, int poses, int threads, Trajectories known) {
  if (poses < 2 || poses > kMostPoses) {
    throw std::invalid_argument("a trajectory has 2 to " + std::to_string(kMostPoses) + " poses, not " +
                                std::to_string(poses));
  }
  Trajectories t = std::move(known);
  const int first = t.count;
  t.count = static_cast<int>(pool.fragments.size());
  t.tips = BodyTips(pool.skeleton).points();
  t.reach = tip_reach(pool.skeleton);
  t.pose_stride = padded(t.tips);
  if (first == 0) t.whole = TipRows(0, t.tips * poses);
  t.whole.resize(t.count);
  fill_whole(pool, poses, thread_count(threads), std::min(first, t.count), t);
  fill_ends(pool, thread_count(threads), t);
  return t;
}

template Trajectories trajectories(const FragmentPool& pool, int poses, int threads, Trajectories known);
template Trajectories trajectories(const PackedPool& pool, int poses, int threads, Trajectories known);

float fragment_distance(const Trajectories& t, int f, int g) { return t.whole.distance(f, t.whole.read(g).data()); }

float transition_distance(const Trajectories& t, int f, int g) {
  return tip_distance(t.last_pose(f), t.first_pose(g), t.pose_stride);
}

}  // namespace fragmotion

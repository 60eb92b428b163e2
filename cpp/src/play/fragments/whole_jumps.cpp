// SPDX-License-Identifier: MIT
#include "fragments/whole_jumps.hpp"

#include <algorithm>
#include <cmath>

#include "motion/pose.hpp"

namespace fragmotion {
namespace {

constexpr double kToDeepest = 0.7;  // s at most from the highest moment of the flight to the deepest of the crouch
constexpr double kToUpright = 0.6;  // s at most from there to where the hips are up
constexpr double kUpright = 0.01;   // m of a 1.8 m character under their highest, from where hips are up

double hips_height(const PackedClip& clip, int frame) { return root_at(clip, frame).place.z(); }
double hips_height(const Clip& clip, int frame) { return clip.root_positions[std::size_t{3} * frame + 2]; }

// The hips' heights over some frames of a clip.
class HipsHeights {
 public:
  template <typename AnyClip>
  HipsHeights(const Skeleton& skeleton, const AnyClip& clip, int first, int last)
      : first_(first), last_(last), tolerance_(kUpright / standard_scale(skeleton)), rate_(clip.rate) {
    for (int f = first; f <= last; ++f) heights_.push_back(hips_height(clip, f));
  }

  double operator()(int frame) const { return heights_[frame - first_]; }

  int highest(int from, int to) const {
    int best = from;
    for (int f = from; f <= to; ++f) best = (*this)(f) > (*this)(best) ? f : best;
    return best;
  }

  // The frame from the highest of a flight on, in the direction of `step`, at which the body is up that was deep.
  int upright(int highest, int step) const {
    int deepest = highest;
    for (int f = highest; within(f) && (f - highest) * step <= kToDeepest * rate_; f += step) {
      if ((*this)(f) < (*this)(deepest)) deepest = f;
    }
    int up = deepest;
    for (int f = deepest; within(f) && (f - deepest) * step <= kToUpright * rate_; f += step) {
      if ((*this)(f) < (*this)(up)-tolerance_) break;
      if ((*this)(f) > (*this)(up)) up = f;
    }
    for (int f = deepest; f != up; f += step) {
      if ((*this)(f) >= (*this)(up)-tolerance_) return f;
    }
    return up;
  }

 private:
  bool within(int frame) const { return frame >= first_ && frame <= last_; }

  int first_, last_;
  double tolerance_, rate_;
  std::vector<double> heights_;
};

// The frames that belong together with a fragment: of a take the fragments that follow each other without a gap, as
// there may be a discontinuity between others, of a synthesized clip all.
template <typename AnyClip>
std::pair<int, int> connected(const Pool<AnyClip>& pool, int fragment) {
  const std::vector<Fragment>& all = pool.fragments;
  const Fragment& f = all[fragment];
  if (f.origin == Origin::interpolated || f.origin == Origin::transformed) return {0, pool.clips[f.clip].frames - 1};
  int first = fragment, last = fragment;
  const auto joined = [&](int i) { return all[i].clip == f.clip && all[i].end == all[i + 1].begin; };
  while (first > 0 && all[first - 1].clip == f.clip && joined(first - 1)) --first;
  while (last + 1 < static_cast<int>(all.size()) && all[last + 1].clip == f.clip && joined(last)) ++last;
  return {all[first].begin, all[last].end};
}

}  // namespace

template <typename AnyClip>
void find_whole_jumps(Pool<AnyClip>& pool) {
  for (int i = 0; i < static_cast<int>(pool.fragments.size()); ++i) {
    Fragment& f = pool.fragments[i];
    f.lead_in = f.lead_out = 0;
    if (!f.evident.jumps()) continue;
    const AnyClip& clip = pool.clips[f.clip];
    const auto [first, last] = connected(pool, i);
    const int far = static_cast<int>((kToDeepest + kToUpright) * clip.rate) + 1;
    const HipsHeights heights(pool.skeleton, clip, std::max(first, f.begin - far), std::min(last, f.end + far));
    const int highest = heights.highest(f.begin, f.end);
    f.lead_in = std::max(0, f.begin - heights.upright(highest, -1));
    f.lead_out = std::max(0, heights.upright(highest, 1) - f.end);
  }
}

template void find_whole_jumps(FragmentPool& pool);
template void find_whole_jumps(PackedPool& pool);

}  // namespace fragmotion

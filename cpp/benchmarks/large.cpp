// SPDX-License-Identifier: MIT
#include "large.hpp"

#include <cmath>

#include "base/random.hpp"
#include "policy/iterate.hpp"
#include "policy/optimal.hpp"
#include "policy/quality_table.hpp"

namespace fragmotion::benchmarks {
namespace {

// One of the workload's fragments as somebody else would do it: a longer or shorter stride, another course, and limbs
// held a little differently.
class Variation {
 public:
  Variation(Random& random, int tips) : offsets_(std::size_t{3} * tips) {
    const auto about = [&](double middle, double width) { return middle + width * (2 * random.uniform() - 1); };
    stretch_ = about(1, 0.15);
    height_ = about(1, 0.05);
    const double course = about(0, 0.2);
    cosine_ = std::cos(course);
    sine_ = std::sin(course);
    for (float& offset : offsets_) offset = static_cast<float>(about(0, 0.03));
  }

  Control operator()(const Control& c) const {
    return {stretch_ * (cosine_ * c.x - sine_ * c.y), stretch_ * (sine_ * c.x + cosine_ * c.y), c.turn, c.jump};
  }

  // Writes the rows [3, stride] of `poses` poses, which may lie where they came from.
  void write(const float* from, int poses, int stride, float* x) const {
    const std::size_t tips = offsets_.size() / 3;
    float *y = x + stride, *z = y + stride;
    for (std::size_t i = 0; i < tips * poses; ++i) {
      const float *offset = &offsets_[3 * (i % tips)], fx = from[i], fy = from[stride + i], fz = from[2 * stride + i];
      x[i] = static_cast<float>(stretch_ * (cosine_ * fx - sine_ * fy)) + offset[0];
      y[i] = static_cast<float>(stretch_ * (sine_ * fx + cosine_ * fy)) + offset[1];
      z[i] = static_cast<float>(height_ * fz) + offset[2];
    }
  }

 private:
  double stretch_ = 1, height_ = 1, cosine_ = 1, sine_ = 0;
  std::vector<float> offsets_;  // [tips, 3] m
};

}  // namespace

LargePool::LargePool(const Workload& w, int count) {
  const Trajectories& from = w.trajectories;
  trajectories.count = count;
  trajectories.tips = from.tips;
  trajectories.whole = TipRows(count, from.whole.stride());
  trajectories.pose_stride = from.pose_stride;
  trajectories.first.resize(std::size_t{3} * count * from.pose_stride);
  trajectories.last.resize(std::size_t{3} * count * from.pose_stride);
  Random random(1);
  for (int i = 0; i < count; ++i) {
    const int base = random.below(from.count);
    const Variation varied(random, from.tips);
    std::vector<float> whole = from.whole.read(base);
    varied.write(whole.data(), kPoses, from.whole.stride(), whole.data());
    trajectories.whole.set(i, whole.data());
    const std::size_t pose = std::size_t{3} * i * from.pose_stride;
    varied.write(from.first_pose(base), 1, from.pose_stride, &trajectories.first[pose]);
    varied.write(from.last_pose(base), 1, from.pose_stride, &trajectories.last[pose]);
    fragments.push_back(w.pool.fragments[base]);
    fragments.back().evident = varied(w.pool.fragments[base].evident);
  }
}

Policy built_policy(const LargePool& large, const Workload& w) {
  const ControlSpace& space = w.built->space;
  const auto quality = [&](const Classes& classes) {
    return quality_table(large.fragments, large.trajectories, classes, space);
  };
  const ClassScore serves_trace = [&](const Classes& classes) {
    return optimal_path(quality(classes), w.controls).quality;
  };
  const std::vector<float> weights(large.trajectories.count, 1);
  const Classes classes = cluster(large.trajectories, weights, clustering(), serves_trace);
  return iterate_policy(quality(classes), {w.controls});
}

}  // namespace fragmotion::benchmarks

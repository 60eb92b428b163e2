// SPDX-License-Identifier: MIT
#include "motion/facing.hpp"

#include <algorithm>
#include <cmath>

namespace fragmotion {
namespace {

constexpr double kSmoothing = 0.25;  // s, standard deviation

std::vector<double> hips_headings(const Kinematics& kinematics, const Clip& clip) {
  const std::size_t hips = kinematics.skeleton().roles.hips;
  std::vector<double> headings(clip.frames);
  for (int f = 0; f < clip.frames; ++f) {
    const double* rotation = &clip.rotations[4 * (static_cast<std::size_t>(f) * kinematics.bones() + hips)];
    headings[f] = kinematics.frame(load_vector(&clip.root_positions[3 * f]), load_quaternion(rotation)).heading;
    if (f > 0) headings[f] = headings[f - 1] + wrapped(headings[f] - headings[f - 1]);
  }
  return headings;
}

// The value at `center` of the line that fits the values around it best, weighted by a Gaussian.
double local_line(const std::vector<double>& values, int center, double sigma) {
  const int reach = static_cast<int>(std::ceil(3 * sigma));
  double w = 0, wx = 0, wxx = 0, wy = 0, wxy = 0;
  for (int i = std::max(0, center - reach); i <= std::min(static_cast<int>(values.size()) - 1, center + reach); ++i) {
    const double x = i - center, weight = std::exp(-0.5 * x * x / (sigma * sigma));
    w += weight;
    wx += weight * x;
    wxx += weight * x * x;
    wy += weight * values[i];
    wxy += weight * x * values[i];
  }
  return (wy * wxx - wxy * wx) / (w * wxx - wx * wx);
}

}  // namespace

std::vector<double> facing(const Kinematics& kinematics, const Clip& clip) {
  const std::vector<double> headings = hips_headings(kinematics, clip);
  std::vector<double> smoothed(headings.size());
  for (int f = 0; f < clip.frames; ++f) smoothed[f] = local_line(headings, f, std::max(1.0, kSmoothing * clip.rate));
  return smoothed;
}

}  // namespace fragmotion

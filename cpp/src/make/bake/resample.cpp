// SPDX-License-Identifier: MIT
#include "bake/resample.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace fragmotion {
namespace {

std::size_t offset(int frame, int width) { return static_cast<std::size_t>(frame) * width; }

}  // namespace

Resampled resampled(const std::vector<double>& times, const Motion& motion, double rate) {
  const int shown = static_cast<int>(times.size()), bones = motion.bones(),
            count = static_cast<int>(std::lround(times.back() * rate)) + 1;
  Resampled result;
  result.motion.rate = rate;
  for (int f = 0; f < count; ++f) {
    const double time = f / rate;
    const auto found = std::lower_bound(times.begin(), times.end(), time) - times.begin();
    const int after = std::clamp(static_cast<int>(found), std::min(1, shown - 1), shown - 1),
              before = std::max(after - 1, 0);
    const double gap = times[after] - times[before],
                 weight = std::clamp((time - times[before]) / (gap > 0 ? gap : 1), 0.0, 1.0);
    const auto mix = [&](const std::vector<double>& from, std::vector<double>& to) {
      for (int i = 0; i < 3; ++i)
        to.push_back((1 - weight) * from[offset(before, 3) + i] + weight * from[offset(after, 3) + i]);
    };
    mix(motion.root_positions, result.motion.root_positions);
    mix(motion.path, result.motion.path);
    result.nearest.push_back(weight < 0.5 ? before : after);
    for (int b = 0; b < bones; ++b) {
      const Quaternion a = load_quaternion(&motion.rotations[offset(before, 4 * bones) + offset(b, 4)]),
                       c = load_quaternion(&motion.rotations[offset(after, 4 * bones) + offset(b, 4)]);
      const double side = a.dot(c) < 0 ? -1 : 1;
      const Quaternion mixed = Quaternion((1 - weight) * a.coeffs() + side * weight * c.coeffs()).normalized();
      result.motion.rotations.insert(result.motion.rotations.end(), {mixed.w(), mixed.x(), mixed.y(), mixed.z()});
    }
  }
  return result;
}

}  // namespace fragmotion

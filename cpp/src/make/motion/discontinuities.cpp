// SPDX-License-Identifier: MIT
#include "motion/discontinuities.hpp"

#include <cmath>

namespace fragmotion {
namespace {

constexpr double kTurn = kPi / 3;  // rad, from one frame to the next
constexpr double kSpeed = 20;      // m/s

}  // namespace

std::vector<int> discontinuities(const Skeleton& skeleton, const Clip& clip) {
  const std::vector<int> bones = measured_bones(skeleton);
  const double least = std::cos(kTurn / 2), farthest = kSpeed / (clip.rate * standard_scale(skeleton));
  const std::size_t width = std::size_t{4} * skeleton.size();
  const auto torn = [&](int f) {
    const double *root = &clip.root_positions[std::size_t{3} * f], *pose = &clip.rotations[width * f];
    if ((load_vector(root) - load_vector(root - 3)).norm() > farthest) return true;
    for (const int b : bones) {
      const double* q = pose + std::ptrdiff_t{4} * b;
      if (std::abs(load_quaternion(q).dot(load_quaternion(q - width))) < least) return true;
    }
    return false;
  };
  std::vector<int> frames;
  for (int f = 1; f < clip.frames; ++f) {
    if (torn(f)) frames.push_back(f);
  }
  return frames;
}

}  // namespace fragmotion

// SPDX-License-Identifier: MIT
#include "motion/pose.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace fragmotion {
namespace {

// The frames on both sides of a time, and how near it is to the second.
struct Between {
  int frame, next;
  double weight;

  Between(const Clip& clip, double at)
      : frame(std::clamp(static_cast<int>(std::floor(at)), 0, clip.frames - 1)),
        next(std::min(frame + 1, clip.frames - 1)),
        weight(std::clamp(at - frame, 0.0, 1.0)) {}

  Vector3 root(const Clip& clip) const {
    return (1 - weight) * load_vector(&clip.root_positions[3 * frame]) +
           weight * load_vector(&clip.root_positions[3 * next]);
  }
};

// As Eigen's own, but for the order of the sum.
Quaternion slerp(const Quaternion& a, const Quaternion& b, double weight) {
  const double along = dot(a.coeffs(), b.coeffs()), cosine = std::abs(along);
  double of_a = 1 - weight, of_b = weight;
  if (cosine < 1 - std::numeric_limits<double>::epsilon()) {
    const double angle = std::acos(cosine), sine = std::sin(angle);
    of_a = std::sin(of_a * angle) / sine;
    of_b = std::sin(of_b * angle) / sine;
  }
  return Quaternion{of_a * a.coeffs() + (along < 0 ? -of_b : of_b) * b.coeffs()};
}

}  // namespace

void add_rotation(const double* rotation, double* sum) {
  const Eigen::Map<const Eigen::Vector4d> q(rotation);
  Eigen::Map<Eigen::Vector4d> all(sum);
  all += dot(all, q) < 0 ? Eigen::Vector4d{-q} : Eigen::Vector4d{q};
}

void extrapolate(const WorldPose& before, const WorldPose& now, WorldPose& later) {
  later.root = 2 * now.root - before.root;
  later.heading = 2 * now.heading - before.heading;
  later.rotations.resize(now.rotations.size());
  for (std::size_t at = 0; at < now.rotations.size(); at += 4) {
    const Quaternion is = load_quaternion(&now.rotations[at]), was = load_quaternion(&before.rotations[at]);
    store_quaternion((is * was.conjugate() * is).normalized(), &later.rotations[at]);
  }
}

void blend_rotations(const double* a, const double* b, double weight, int bones, double* out) {
  for (int i = 0; i < 4 * bones; i += 4) {
    store_quaternion(slerp(load_quaternion(a + i), load_quaternion(b + i), weight), out + i);
  }
}

Vector3 sample_pose(const Clip& clip, double at, double* rotations) {
  const Between between(clip, at);
  const std::size_t width = clip.rotations.size() / clip.frames;
  const double *a = &clip.rotations[width * between.frame], *b = &clip.rotations[width * between.next];
  if (between.weight == 0) {
    std::copy(a, a + width, rotations);
  } else {
    blend_rotations(a, b, between.weight, static_cast<int>(width / 4), rotations);
  }
  return between.root(clip);
}

CharacterFrame frame_at(const Clip& clip, double at) {
  const Between between(clip, at);
  const double heading = clip.headings[between.frame], next = clip.headings[between.next];
  return {between.root(clip).head<2>(), heading + between.weight * (next - heading)};
}

}  // namespace fragmotion

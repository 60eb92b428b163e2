// SPDX-License-Identifier: MIT
#include "fragmotion/runtime/inertialization.hpp"

#include <algorithm>
#include <cmath>

#include "base/vectorised.hpp"
#include "fragmotion/motion/pose.hpp"

namespace fragmotion {
namespace {

constexpr double kLasts = 4;  // times the seconds of a stitch, until nothing is seen of it

// A rotation as axis * tan(angle / 4): free of trigonometry, and smooth up to a whole turn. Of a quaternion and its
// negative, which are the same rotation, one is the long way round.
Vector3 turn_of(const Quaternion& q) { return q.vec() / (1 + q.w()); }

using Lanes = float[kBoneBlock];

// Turns the rotations [bones, 4] further by what is left of the offsets and the speeds.
FRAGMOTION_VECTORISED void add_turns(const BoneOffsets* blocks, int bones, float offset, float speed,
                                     double* rotations) {
  for (; bones > 0; bones -= kBoneBlock, ++blocks, rotations += 4 * kBoneBlock) {
    const int values = 4 * std::min(kBoneBlock, bones);
    float q[kBoneBlock][4] = {};
    std::copy_n(rotations, values, &q[0][0]);
    const auto& [turn, turning] = *blocks;
    Lanes w, x, y, z;
    for (int i = 0; i < kBoneBlock; ++i) {
      const float a = offset * turn[0][i] + speed * turning[0][i], b = offset * turn[1][i] + speed * turning[1][i],
                  c = offset * turn[2][i] + speed * turning[2][i], square = a * a + b * b + c * c,
                  scale = 1 / (1 + square);
      w[i] = (1 - square) * scale;
      x[i] = 2 * scale * a;
      y[i] = 2 * scale * b;
      z[i] = 2 * scale * c;
    }
    for (int i = 0; i < kBoneBlock; ++i) {
      const float a = q[i][0], b = q[i][1], c = q[i][2], d = q[i][3];
      q[i][0] = w[i] * a - x[i] * b - y[i] * c - z[i] * d;
      q[i][1] = w[i] * b + x[i] * a + y[i] * d - z[i] * c;
      q[i][2] = w[i] * c - x[i] * d + y[i] * a + z[i] * b;
      q[i][3] = w[i] * d + x[i] * c - y[i] * b + z[i] * a;
    }
    std::copy_n(&q[0][0], values, rotations);
  }
}

}  // namespace

Inertialization::Inertialization(int bones, const StitchConstants& constants)
    : constants_(constants), bones_(bones), blocks_((bones + kBoneBlock - 1) / kBoneBlock) {}

Vector2 Inertialization::begin(const WorldPose& old_before, const WorldPose& old, const WorldPose& fresh,
                               const WorldPose& fresh_later, double apart, double seconds) {
  damping_ = constants_.fades / seconds;
  end_ = kLasts * seconds;
  root_ = old.root - fresh.root;
  const Vector3 faster = (old.root - old_before.root - (fresh_later.root - fresh.root)) / apart;
  root_speed_ = {0, 0, faster.z()};
  heading_ = old.heading - fresh.heading;
  heading_speed_ = (old.heading - old_before.heading - (fresh_later.heading - fresh.heading)) / apart;
  for (std::size_t b = 0; b < static_cast<std::size_t>(bones_); ++b) {
    const double *was = &old_before.rotations[4 * b], *is = &old.rotations[4 * b], *starts = &fresh.rotations[4 * b];
    Quaternion offset = load_quaternion(is) * load_quaternion(starts).conjugate();
    if (offset.w() < 0) offset.coeffs() *= -1;
    // What the old bone turns in `apart`, and then the new one, both about the world of the parent.
    const Quaternion next_old = load_quaternion(is) * load_quaternion(was).conjugate() * load_quaternion(is);
    Quaternion next = next_old * load_quaternion(&fresh_later.rotations[4 * b]).conjugate();
    if (next.dot(offset) < 0) next.coeffs() *= -1;
    const Vector3 turn = turn_of(offset), turning = (turn_of(next) - turn) / apart;
    for (int axis = 0; axis < 3; ++axis) {
      blocks_[b / kBoneBlock].turn[axis][b % kBoneBlock] = static_cast<float>(turn[axis]);
      blocks_[b / kBoneBlock].turning[axis][b % kBoneBlock] = static_cast<float>(turning[axis]);
    }
  }
  return faster.head<2>();
}

void Inertialization::apply(double time, WorldPose& pose) const {
  if (!active(time)) return;
  const double offset = (1 + damping_ * time) * std::exp(-damping_ * time),
               speed = time * std::exp(-std::max(damping_, constants_.calms) * time);
  pose.root += offset * root_ + speed * root_speed_;
  pose.heading += offset * heading_ + speed * heading_speed_;
  add_turns(blocks_.data(), bones_, static_cast<float>(offset), static_cast<float>(speed), pose.rotations.data());
}

}  // namespace fragmotion

// SPDX-License-Identifier: MIT
#include "runtime/inertialization.hpp"

#include <algorithm>
#include <cmath>

#include "base/filtered.hpp"
#include "base/vectorised.hpp"
#include "motion/pose.hpp"

namespace fragmotion {
namespace {

// A rotation as axis * tan(angle / 4): free of trigonometry, and smooth up to a whole turn. Of a quaternion and its
// negative, which are the same rotation, one is the long way round.
Vector3 turn_of(const Quaternion& q) { return q.vec() / (1 + q.w()); }

// Rounding errors are no offset: their squares are denormal numbers, with which processors are slow.
float rounded(double value) { return std::abs(value) < 1e-12 ? 0.0F : static_cast<float>(value); }

// Turns the rotations of a block of bones, of whose offsets so many are in a row.
[[gnu::always_inline]] inline void turn_block(const float* offsets, int row, float offset, float speed,
                                              double* rotations) {
  const float *x = offsets, *y = x + row, *z = y + row, *to_x = z + row, *to_y = to_x + row, *to_z = to_y + row;
  float turn[4][kBoneBlock];
  for (int i = 0; i < kBoneBlock; ++i) {
    const float a = offset * x[i] + speed * to_x[i], b = offset * y[i] + speed * to_y[i],
                c = offset * z[i] + speed * to_z[i], square = a * a + b * b + c * c, scale = 1 / (1 + square);
    turn[0][i] = (1 - square) * scale;
    turn[1][i] = 2 * scale * a;
    turn[2][i] = 2 * scale * b;
    turn[3][i] = 2 * scale * c;
  }
  for (int i = 0; i < kBoneBlock; ++i) {
    double* q = rotations + std::ptrdiff_t{4} * i;
    const auto a = static_cast<float>(q[0]), b = static_cast<float>(q[1]), c = static_cast<float>(q[2]),
               d = static_cast<float>(q[3]);
    const float w = turn[0][i], r = turn[1][i], s = turn[2][i], t = turn[3][i];
    q[0] = w * a - r * b - s * c - t * d;
    q[1] = w * b + r * a + s * d - t * c;
    q[2] = w * c - r * d + s * a + t * b;
    q[3] = w * d + r * c - s * b + t * a;
  }
}

// Turns the rotations [bones, 4] further by what is left of the offsets and the speeds.
FRAGMOTION_VECTORISED void add_turns(const float* offsets, int bones, float offset, float speed, double* rotations) {
  for (; bones >= kBoneBlock; bones -= kBoneBlock, offsets += 6 * kBoneBlock, rotations += 4 * kBoneBlock)
    turn_block(offsets, kBoneBlock, offset, speed, rotations);
  if (bones == 0) return;
  // Bones that are no whole block, with room for one: beyond them is what nobody asks for.
  float few[6 * kBoneBlock] = {};
  double turned[4 * kBoneBlock] = {};
  std::copy_n(offsets, 6 * bones, few);
  std::copy_n(rotations, 4 * bones, turned);
  turn_block(few, bones, offset, speed, turned);
  std::copy_n(turned, 4 * bones, rotations);
}

}  // namespace

TurnOffset turn_offset(const double* old, const double* old_later, const double* fresh, const double* fresh_later,
                       double apart) {
  Quaternion offset = load_quaternion(old) * load_quaternion(fresh).conjugate();
  if (offset.w() < 0) offset.coeffs() *= -1;
  Quaternion next = load_quaternion(old_later) * load_quaternion(fresh_later).conjugate();
  if (dot(next.coeffs(), offset.coeffs()) < 0) next.coeffs() *= -1;
  const Vector3 turn = turn_of(offset);
  return {turn, (turn_of(next) - turn) / apart};
}

Inertialization::Inertialization(int bones, const StitchConstants& constants)
    : constants_(&constants), offsets_(std::size_t{6} * bones) {}

Vector2 Inertialization::begin(const WorldPose& old, const WorldPose& old_later, const WorldPose& fresh,
                               const WorldPose& fresh_later, double apart, double seconds) {
  damping_ = constants_->fades / seconds;
  end_ = kUnseen * seconds;
  root_ = old.root - fresh.root;
  const Vector3 faster = (old_later.root - old.root - (fresh_later.root - fresh.root)) / apart;
  root_speed_ = {0, 0, faster.z()};
  heading_ = old.heading - fresh.heading;
  heading_speed_ = (old_later.heading - old.heading - (fresh_later.heading - fresh.heading)) / apart;
  for (int b = 0; b < bones(); ++b) {
    const std::ptrdiff_t at = std::ptrdiff_t{4} * b;
    keep(b, turn_offset(&old.rotations[at], &old_later.rotations[at], &fresh.rotations[at], &fresh_later.rotations[at],
                        apart));
  }
  return faster.head<2>();
}

// Where one of the six values of a bone is kept.
std::size_t Inertialization::slot(int bone, int value) const {
  const int lane = bone % kBoneBlock, first = bone - lane, count = std::min(kBoneBlock, bones() - first);
  return std::size_t{6} * first + static_cast<std::size_t>(value) * count + lane;
}

void Inertialization::keep(int bone, const TurnOffset& offset) {
  for (int axis = 0; axis < 3; ++axis) {
    offsets_[slot(bone, axis)] = rounded(offset.turn[axis]);
    offsets_[slot(bone, 3 + axis)] = rounded(offset.turning[axis]);
  }
}

Quaternion Inertialization::left(int bone, const Fade& fade) const {
  Vector3 turn;
  for (int axis = 0; axis < 3; ++axis) {
    turn[axis] = fade.offset * offsets_[slot(bone, axis)] + fade.speed * offsets_[slot(bone, 3 + axis)];
  }
  const double square = turn.squaredNorm();
  Quaternion q;
  q.w() = (1 - square) / (1 + square);
  q.vec() = 2 / (1 + square) * turn;
  return q;
}

Fade Inertialization::fade(double damping, double time) const {
  const double fades = std::exp(-damping * time), calms = constants_->calms;
  return {(1 + damping * time) * fades, time * (damping < calms ? std::exp(-calms * time) : fades)};
}

void Inertialization::apply(double time, WorldPose& pose) const {
  if (!active(time)) return;
  const Fade left = fade(damping_, time);
  move(left, pose);
  add_turns(offsets_.data(), bones(), static_cast<float>(left.offset), static_cast<float>(left.speed),
            pose.rotations.data());
}

void Inertialization::move(double time, WorldPose& pose) const {
  if (active(time)) move(fade(damping_, time), pose);
}

void Inertialization::move(const Fade& left, WorldPose& pose) const {
  pose.root += left.offset * root_ + left.speed * root_speed_;
  pose.heading += left.offset * heading_ + left.speed * heading_speed_;
}

}  // namespace fragmotion

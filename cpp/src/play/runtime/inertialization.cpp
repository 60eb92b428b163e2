// SPDX-License-Identifier: MIT
#include "runtime/inertialization.hpp"

#include <algorithm>
#include <cmath>

#include "base/filtered.hpp"
#include "motion/pose.hpp"

namespace fragmotion {
namespace {

// A rotation as axis * tan(angle / 4): free of trigonometry, and smooth up to a whole turn. Of a quaternion and its
// negative, which are the same rotation, one is the long way round.
Vector3 turn_of(const Quaternion& q) { return q.vec() / (1 + q.w()); }

// Rounding errors are no offset: their squares are denormal numbers, with which processors are slow.
float rounded(double value) { return std::abs(value) < 1e-12 ? 0.0F : static_cast<float>(value); }

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
    : constants_(&constants), offsets_(std::size_t{6} * bones + kBoneBlock - 1) {}

Vector2 Inertialization::begin(const WorldPose& old, const WorldPose& old_later, const WorldPose& fresh,
                               const WorldPose& fresh_later, double apart, double seconds, const PackedClip* clip) {
  damping_ = constants_->fades / seconds;
  end_ = kUnseen * seconds;
  root_ = old.root - fresh.root;
  const Vector3 faster = (old_later.root - old.root - (fresh_later.root - fresh.root)) / apart;
  root_speed_ = {0, 0, faster.z()};
  heading_ = old.heading - fresh.heading;
  heading_speed_ = (old_later.heading - old.heading - (fresh_later.heading - fresh.heading)) / apart;
  for (int b = 0; b < bones(); ++b) {
    const std::ptrdiff_t at = std::ptrdiff_t{4} * b;
    keep(clip != nullptr ? clip->lane_of(b) : b, turn_offset(&old.rotations[at], &old_later.rotations[at],
                                                             &fresh.rotations[at], &fresh_later.rotations[at], apart));
  }
  return faster.head<2>();
}

// Where one of the six values of a lane is kept.
std::size_t Inertialization::slot(int lane, int value) const {
  const int in_block = lane % kBoneBlock, first = lane - in_block, count = std::min(kBoneBlock, bones() - first);
  return std::size_t{6} * first + static_cast<std::size_t>(value) * count + in_block;
}

void Inertialization::keep(int lane, const TurnOffset& offset) {
  for (int axis = 0; axis < 3; ++axis) {
    offsets_[slot(lane, axis)] = rounded(offset.turn[axis]);
    offsets_[slot(lane, 3 + axis)] = rounded(offset.turning[axis]);
  }
}

Quaternion Inertialization::turn(int lane, const Fade& left) const {
  Vector3 turn;
  for (int axis = 0; axis < 3; ++axis) {
    turn[axis] = left.offset * offsets_[slot(lane, axis)] + left.speed * offsets_[slot(lane, 3 + axis)];
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

Fade Inertialization::left(double time) const { return active(time) ? fade(damping_, time) : Fade{}; }

FadingTurns Inertialization::turns(const Fade& left) const {
  if (left.offset == 0) return {};
  return {offsets_.data(), static_cast<float>(left.offset), static_cast<float>(left.speed)};
}

void Inertialization::move(const Fade& left, WorldPose& pose) const {
  pose.root += left.offset * root_ + left.speed * root_speed_;
  pose.heading += left.offset * heading_ + left.speed * heading_speed_;
}

void Inertialization::apply(double time, WorldPose& pose) const {
  const Fade left = this->left(time);
  move(left, pose);
  for (int b = 0; b < bones() && left.offset != 0; ++b) {
    double* rotation = &pose.rotations[std::size_t{4} * b];
    store_quaternion(product(turn(b, left), load_quaternion(rotation)), rotation);
  }
}

}  // namespace fragmotion

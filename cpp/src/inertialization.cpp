// SPDX-License-Identifier: MIT
#include "fragmotion/inertialization.hpp"

#include "fragmotion/pose.hpp"

namespace fragmotion {
namespace {

// The rotation from b to a as axis * tan(angle / 4): free of trigonometry, and smooth up to a whole turn.
Vector3 turn_between(const double* a, const double* b) {
  const Quaternion q = load_quaternion(a) * load_quaternion(b).conjugate();
  return q.w() < 0 ? Vector3{-q.vec() / (1 - q.w())} : Vector3{q.vec() / (1 + q.w())};
}

Quaternion rotation_of(const Vector3& turn) {
  const double square = turn.squaredNorm(), scale = 1 / (1 + square);
  Quaternion q;
  q.w() = (1 - square) * scale;
  q.vec() = 2 * scale * turn;
  return q;
}

}  // namespace

Inertialization::Inertialization(int bones) : turns_(bones), turn_speeds_(bones) {}

void Inertialization::begin(const WorldPose& old, const WorldPose& old_later, const WorldPose& fresh,
                            const WorldPose& fresh_later, double later, double seconds) {
  seconds_ = seconds;
  root_ = old.root - fresh.root;
  root_speed_ = (old_later.root - fresh_later.root - root_) / later;
  heading_ = old.heading - fresh.heading;
  heading_speed_ = (old_later.heading - fresh_later.heading - heading_) / later;
  for (std::size_t b = 0; b < turns_.size(); ++b) {
    turns_[b] = turn_between(&old.rotations[4 * b], &fresh.rotations[4 * b]);
    turn_speeds_[b] = (turn_between(&old_later.rotations[4 * b], &fresh_later.rotations[4 * b]) - turns_[b]) / later;
  }
}

void Inertialization::apply(double time, WorldPose& pose) const {
  if (time >= seconds_) return;
  const double phase = time / seconds_, offset = 1 - ease_in_ease_out(phase), speed = time * (1 - phase) * (1 - phase);
  pose.root += offset * root_ + speed * root_speed_;
  pose.heading += offset * heading_ + speed * heading_speed_;
  for (std::size_t b = 0; b < turns_.size(); ++b) {
    double* rotation = &pose.rotations[4 * b];
    const Vector3 turn = offset * turns_[b] + speed * turn_speeds_[b];
    store_quaternion(rotation_of(turn) * load_quaternion(rotation), rotation);
  }
}

}  // namespace fragmotion

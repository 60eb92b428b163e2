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

void Inertialization::begin(const WorldPose& old_before, const WorldPose& old, const WorldPose& fresh,
                            const WorldPose& fresh_later, double apart, double seconds) {
  seconds_ = seconds;
  root_ = old.root - fresh.root;
  root_speed_ = (old.root - old_before.root - (fresh_later.root - fresh.root)) / apart;
  heading_ = old.heading - fresh.heading;
  heading_speed_ = (old.heading - old_before.heading - (fresh_later.heading - fresh.heading)) / apart;
  for (std::size_t b = 0; b < turns_.size(); ++b) {
    const double *was = &old_before.rotations[4 * b], *is = &old.rotations[4 * b], *starts = &fresh.rotations[4 * b];
    const Vector3 offset = turn_between(is, starts);
    // What the old bone turns in `apart`, and then the new one, both about the world of the parent.
    const Quaternion next_old = load_quaternion(is) * load_quaternion(was).conjugate() * load_quaternion(is);
    double next[4];
    store_quaternion(next_old, next);
    turns_[b] = offset;
    turn_speeds_[b] = (turn_between(next, &fresh_later.rotations[4 * b]) - offset) / apart;
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

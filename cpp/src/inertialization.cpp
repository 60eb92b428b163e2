// SPDX-License-Identifier: MIT
#include "fragmotion/inertialization.hpp"

#include <cmath>

#include "fragmotion/pose.hpp"

namespace fragmotion {
namespace {

constexpr double kFades = 2.4;  // (1 + kFades) exp(-kFades) is three tenths
constexpr double kLasts = 4;    // times that, until nothing is seen of it

// The rotation from b to a as axis * tan(angle / 4): free of trigonometry, and smooth up to a whole turn.
Vector3 turn_between(const double* a, const double* b) {
  const Quaternion q = load_quaternion(a) * load_quaternion(b).conjugate();
  return q.w() < 0 ? Vector3{-q.vec() / (1 - q.w())} : Vector3{q.vec() / (1 + q.w())};
}

// Turns a rotation further. Number by number, so that nothing waits for numbers that were just stored in other parts.
inline void add_turn(const Vector3& turn, double* wxyz) {
  const double square = turn.squaredNorm(), scale = 1 / (1 + square), twice = 2 * scale;
  const double w = (1 - square) * scale, x = twice * turn.x(), y = twice * turn.y(), z = twice * turn.z();
  const double a = wxyz[0], b = wxyz[1], c = wxyz[2], d = wxyz[3];
  wxyz[0] = w * a - x * b - y * c - z * d;
  wxyz[1] = w * b + x * a + y * d - z * c;
  wxyz[2] = w * c - x * d + y * a + z * b;
  wxyz[3] = w * d + x * c - y * b + z * a;
}

}  // namespace

Inertialization::Inertialization(int bones) : turns_(bones), turn_speeds_(bones) {}

void Inertialization::begin(const WorldPose& old_before, const WorldPose& old, const WorldPose& fresh,
                            const WorldPose& fresh_later, double apart, double seconds) {
  damping_ = kFades / seconds;
  end_ = kLasts * seconds;
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
  if (!active(time)) return;
  const double left = std::exp(-damping_ * time), offset = (1 + damping_ * time) * left, speed = time * left;
  pose.root += offset * root_ + speed * root_speed_;
  pose.heading += offset * heading_ + speed * heading_speed_;
  for (std::size_t b = 0; b < turns_.size(); ++b) {
    add_turn(offset * turns_[b] + speed * turn_speeds_[b], &pose.rotations[4 * b]);
  }
}

}  // namespace fragmotion

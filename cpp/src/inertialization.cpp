// SPDX-License-Identifier: MIT
#include "fragmotion/inertialization.hpp"

#include <algorithm>
#include <cmath>

#include "fragmotion/pose.hpp"

namespace fragmotion {
namespace {

constexpr double kFades = 2.4;  // (1 + kFades) exp(-kFades) is three tenths
constexpr double kCalms = 12;   // 1/s: at least so fast fade speeds, which carry a pose too far in a long stitch
constexpr double kLasts = 4;    // times that, until nothing is seen of it

// A rotation as axis * tan(angle / 4): free of trigonometry, and smooth up to a whole turn. Of a quaternion and its
// negative, which are the same rotation, one is the long way round.
Vector3 turn_of(const Quaternion& q) { return q.vec() / (1 + q.w()); }

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

Inertialization::Inertialization(int bones) : bones_(bones) {}

void Inertialization::begin(const WorldPose& old_before, const WorldPose& old, const WorldPose& fresh,
                            const WorldPose& fresh_later, double apart, double seconds) {
  damping_ = kFades / seconds;
  end_ = kLasts * seconds;
  root_ = old.root - fresh.root;
  root_speed_ = (old.root - old_before.root - (fresh_later.root - fresh.root)) / apart;
  heading_ = old.heading - fresh.heading;
  heading_speed_ = (old.heading - old_before.heading - (fresh_later.heading - fresh.heading)) / apart;
  for (std::size_t b = 0; b < bones_.size(); ++b) {
    const double *was = &old_before.rotations[4 * b], *is = &old.rotations[4 * b], *starts = &fresh.rotations[4 * b];
    Quaternion offset = load_quaternion(is) * load_quaternion(starts).conjugate();
    if (offset.w() < 0) offset.coeffs() *= -1;
    // What the old bone turns in `apart`, and then the new one, both about the world of the parent.
    const Quaternion next_old = load_quaternion(is) * load_quaternion(was).conjugate() * load_quaternion(is);
    Quaternion next = next_old * load_quaternion(&fresh_later.rotations[4 * b]).conjugate();
    if (next.dot(offset) < 0) next.coeffs() *= -1;
    const Vector3 turn = turn_of(offset);
    bones_[b] = {turn, (turn_of(next) - turn) / apart};
  }
}

void Inertialization::apply(double time, WorldPose& pose) const {
  if (!active(time)) return;
  const double offset = (1 + damping_ * time) * std::exp(-damping_ * time),
               speed = time * std::exp(-std::max(damping_, kCalms) * time);
  pose.root += offset * root_ + speed * root_speed_;
  pose.heading += offset * heading_ + speed * heading_speed_;
  for (std::size_t b = 0; b < bones_.size(); ++b) {
    add_turn(offset * bones_[b].turn + speed * bones_[b].speed, &pose.rotations[4 * b]);
  }
}

}  // namespace fragmotion

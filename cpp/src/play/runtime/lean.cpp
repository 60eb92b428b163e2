// SPDX-License-Identifier: MIT
#include "runtime/lean.hpp"

#include <cmath>

#include "base/filtered.hpp"

namespace fragmotion {
namespace {

constexpr double kShare = 0.5;     // of the angle that would balance the body
constexpr double kFollows = 0.12;  // s: time constant of each of two filters, so that no lean begins with a jerk
constexpr double kMost = 6,
                 kLeast = 0.1;  // m/s^2 of a 1.8 m character that it follows, and below which nothing is seen

// Half an angle, as the quaternions of turns by it have it.
struct Half {
  double cosine, sine;

  explicit Half(double angle) : cosine(std::cos(angle / 2)), sine(std::sin(angle / 2)) {}
  Quaternion about(const Vector3& axis) const { return {cosine, sine * axis.x(), sine * axis.y(), sine * axis.z()}; }
};

// Leans thighs, hips, spine and head in one way, which starts with the thighs and ends at the head. Turns about one
// axis of the world change nothing of what is above them, as that axis sees it: each is told by the pose as it was.
class LeaningBody {
 public:
  LeaningBody(const Skeleton& skeleton, const Trunk& trunk, double heading, const Vector2& lean, double* rotations)
      : skeleton_(skeleton),
        trunk_(trunk),
        rotations_(rotations),
        hips_(lean.y()),
        spine_(lean.x() / spine_bones(skeleton, trunk)),
        head_forward_(-kHeadBack * lean.y()),
        head_aside_(-kHeadBack * lean.x()),
        left_{-std::cos(heading), -std::sin(heading), 0} {
    const double cosine = hips_.cosine * hips_.cosine - hips_.sine * hips_.sine;
    forward_ = {left_.y() * cosine, -left_.x() * cosine, 2 * hips_.sine * hips_.cosine};
  }

  // Lets a thigh stay as it is while the hips lean.
  void keep(int thigh) {
    const Quaternion back = world_turn(skeleton_, thigh, rotations_).conjugate();
    turn(thigh, hips_.about(turned(back, -left_)));
  }

  // Leans from the hips to a bone; returns how that was turned in the world.
  Quaternion lean_to(int bone) {
    const Quaternion was = load_quaternion(&rotations_[std::size_t{4} * bone]);
    if (bone == skeleton_.roles.hips) {
      store_quaternion(hips_.about(left_) * was, &rotations_[std::size_t{4} * bone]);
      return was;
    }
    const Quaternion world = lean_to(skeleton_.parents[bone]) * was, back = world.conjugate();
    is_spine_ = is_spine_ || bone == trunk_.base;
    if (is_spine_) turn(bone, spine_.about(turned(back, forward_)));
    if (bone == trunk_.chest) is_spine_ = false;
    if (bone == trunk_.head) {
      turn(bone, head_aside_.about(turned(back, forward_)));
      turn(bone, head_forward_.about(turned(back, left_)));
    }
    return world;
  }

 private:
  void turn(int bone, const Quaternion& by) {
    double* local = &rotations_[std::size_t{4} * bone];
    store_quaternion(load_quaternion(local) * by, local);
  }

  const Skeleton& skeleton_;
  const Trunk& trunk_;
  double* rotations_;
  Half hips_, spine_, head_forward_, head_aside_;
  Vector3 left_, forward_;  // the latter as hips that have not leaned yet see it
  bool is_spine_ = false;
};

}  // namespace

void Lean::apply(const Skeleton& skeleton, WorldPose& pose, const Vector2& acceleration, double seconds) {
  const Vector2 wanted = clamp_length(scale_ * acceleration, kMost);
  const double part = filtered(seconds, kFollows);
  pushed_ += part * (wanted - pushed_);
  acceleration_ += part * (pushed_ - acceleration_);
  const double strength = acceleration_.norm();
  if (strength < kLeast || trunk_.base < 0) return;
  const Vector2 lean = kShare * std::atan(strength / kGravity) / strength * acceleration_;
  LeaningBody body(skeleton, trunk_, pose.heading, lean, pose.rotations.data());
  for (const int thigh : thighs_) {
    if (thigh >= 0) body.keep(thigh);
  }
  body.lean_to(trunk_.head >= 0 ? trunk_.head : trunk_.chest);
}

}  // namespace fragmotion

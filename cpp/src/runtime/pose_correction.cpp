// SPDX-License-Identifier: MIT
#include "fragmotion/runtime/pose_correction.hpp"

#include <algorithm>
#include <cmath>

namespace fragmotion {
namespace {

constexpr double kMostAdjusted = 0.6;  // of a fragment's speed,
constexpr double kMostTurned = 1;      // and of the turn rate
constexpr double kAdjusting = 0.05;    // s: time constant of the velocity's adjustment,
constexpr double kTurning = 0.1;       // and of the turn rate's
constexpr double kHeading = 0.15;      // s in which the heading gets to where it is led,
constexpr double kLeash = 0.5;         // rad by which it is led at most
constexpr double kStill = 0.2;         // m/s of a 1.8 m character, and of the turn rate, below which it stands

}  // namespace

PoseCorrection::PoseCorrection(const Character& character, Workspace& workspace, double root_adjustment,
                               double acceleration, bool lock_feet)
    : character_(&character),
      workspace_(&workspace),
      root_adjustment_(root_adjustment),
      acceleration_(acceleration),
      lock_feet_(lock_feet),
      foot_lock_(workspace.body),
      breathing_(workspace.kinematics.skeleton()) {}

void PoseCorrection::reset(double heading) {
  velocity_ = Vector2::Zero();
  turn_rate_ = 0;
  led_ = heading;
  foot_lock_.reset();
  breathing_.reset();
}

// The velocity that the fragment lacks, as far as its strides can be changed.
Vector2 PoseCorrection::velocity_to_add(const Control& control, const Control& evident) const {
  const Vector2 lacks{control.x - evident.x, control.y - evident.y};
  return root_adjustment_ * clamp_length(lacks, kMostAdjusted * evident.speed());
}

// The turn rate that the fragment lacks, and what brings back the heading that it has lost.
double PoseCorrection::turn_to_add(const Control& control, const Playback& playback, double seconds) {
  const double unit = character_->space.turn_rate(), heading = playback.frame().heading;
  led_ += seconds * control.turn * unit;
  const double behind = std::clamp(std::remainder(led_ - heading, 2 * kPi), -kLeash, kLeash);
  led_ = heading + behind;
  const double lacks = control.turn - playback.evident().turn + behind / kHeading / unit;
  return root_adjustment_ * unit * std::clamp(lacks, -kMostTurned, kMostTurned);
}

void PoseCorrection::adjust_root(const Control& control, double seconds, Playback& playback) {
  const auto part = [&](double time) { return 1 - std::exp(-seconds / time); };
  const Vector2 change = part(kAdjusting) * (velocity_to_add(control, playback.evident()) - velocity_);
  velocity_ += clamp_length(change, acceleration_ * seconds);
  turn_rate_ += part(kTurning) * (turn_to_add(control, playback, seconds) - turn_rate_);
  playback.move(velocity_, turn_rate_, seconds);
}

void PoseCorrection::correct(const Playback& playback, double seconds) {
  breathing_.apply(workspace_->kinematics.skeleton(), workspace_->shown, stands(playback.evident()), seconds);
  if (lock_feet_) lock_feet(playback, seconds);
}

bool PoseCorrection::stands(const Control& evident) const {
  return evident.speed() * character_->space.scale() < kStill && std::abs(evident.turn) < kStill && !evident.jumps();
}

void PoseCorrection::lock_feet(const Playback& playback, double seconds) {
  const Fragment& f = character_->pool.fragments[playback.fragment()];
  const Contacts& contacts = character_->contacts[f.clip];
  if (contacts.feet[0].empty()) return;
  const PackedClip& clip = character_->pool.clips[f.clip];
  const long at = std::lround(f.begin + playback.seconds() * clip.rate);
  const auto frame = static_cast<std::size_t>(std::clamp(at, 0L, static_cast<long>(clip.frames) - 1));
  foot_lock_.apply(workspace_->shown, contacts, frame, seconds);
}

}  // namespace fragmotion

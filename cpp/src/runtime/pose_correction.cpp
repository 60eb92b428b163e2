// SPDX-License-Identifier: MIT
#include "fragmotion/runtime/pose_correction.hpp"

#include <algorithm>
#include <cmath>

namespace fragmotion {
namespace {

constexpr double kMostAdjusted = 0.4;  // of a fragment's speed and of the turn rate
constexpr double kAdjusting = 0.1;     // s: time constant of the adjustment
constexpr double kStill = 0.2;         // m/s of a 1.8 m character, and of the turn rate, below which it stands

}  // namespace

PoseCorrection::PoseCorrection(const Character& character, Workspace& workspace, double root_adjustment, bool lock_feet)
    : character_(&character),
      workspace_(&workspace),
      root_adjustment_(root_adjustment),
      lock_feet_(lock_feet),
      foot_lock_(workspace.body),
      breathing_(workspace.kinematics.skeleton()) {}

void PoseCorrection::reset() {
  velocity_ = Vector2::Zero();
  turn_rate_ = 0;
  foot_lock_.reset();
  breathing_.reset();
}

void PoseCorrection::adjust_root(const Control& control, double seconds, Playback& playback) {
  const Control& ev = playback.evident();
  Vector2 missing{control.x - ev.x, control.y - ev.y};
  const double most = kMostAdjusted * ev.speed();
  if (missing.norm() > most) missing *= most / missing.norm();
  const double turn = std::clamp(control.turn - ev.turn, -kMostAdjusted, kMostAdjusted) * character_->space.turn_rate();
  const double share = 1 - std::exp(-seconds / kAdjusting);
  velocity_ += share * (root_adjustment_ * missing - velocity_);
  turn_rate_ += share * (root_adjustment_ * turn - turn_rate_);
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

// SPDX-License-Identifier: MIT
#include "fragmotion/runtime/pose_correction.hpp"

#include <algorithm>
#include <cmath>

#include "base/filtered.hpp"

namespace fragmotion {
namespace {

constexpr double kMostAdjusted = 0.6;              // of a fragment's speed,
constexpr double kMostTurned = 1;                  // and of the turn rate, for the heading
constexpr double kTurning = 0.05;                  // s: time constant of the turn rate's adjustment
constexpr double kSlowest = 0.75, kFastest = 1.2;  // of the tempo
constexpr double kPacing = 0.15;                   // s: time constant of the tempo's,
constexpr double kSetOff = 0.15;   // of what balances it that the feet are set off for a body's acceleration
constexpr double kStriding = 0.3;  // s: time constant of the steps'
constexpr double kHeading = 0.12;  // s in which the heading gets to the target heading,
constexpr double kLeash = 0.5;     // rad by which that is ahead of it at most
constexpr double kSways = 0.05;    // m/s of a 1.8 m character, at most, at which one sways that stands

}  // namespace

PoseCorrection::PoseCorrection(const Character& character, Workspace& workspace, double root_adjustment,
                               double acceleration, bool lock_feet)
    : space_(&character.space),
      workspace_(&workspace),
      root_adjustment_(root_adjustment),
      acceleration_(acceleration),
      lock_feet_(lock_feet),
      foot_lock_(workspace.body),
      lean_(Trunk(workspace.kinematics.skeleton()), character.space.scale()) {}

void PoseCorrection::reset(double heading) {
  velocity_ = Vector2::Zero();
  begins_ = true;
  turn_rate_ = 0;
  tempo_ = 1;
  target_heading_ = heading;
  steps_ = {};
  foot_lock_.reset();
  lean_.reset();
}

// The velocity that the fragment lacks now, as far as its strides can be changed. Who stands may sway.
Vector2 PoseCorrection::velocity_to_add(const Control& control, const Vector2& velocity) const {
  if (control.speed() == 0 && velocity.norm() * space_->scale() < kSways) return Vector2::Zero();
  const Vector2 lacks = Vector2{control.x, control.y} - tempo_ * velocity;
  return root_adjustment_ * clamp_length(lacks, kMostAdjusted * velocity.norm());
}

// The turn rate that the fragment lacks, and what brings back the heading that it has lost.
double PoseCorrection::turn_to_add(const Control& control, const Playback& playback, double seconds) {
  const double unit = space_->turn_rate(), heading = playback.frame().heading;
  target_heading_ += seconds * control.turn * unit;
  const double behind = std::clamp(std::remainder(target_heading_ - heading, 2 * kPi), -kLeash, kLeash);
  target_heading_ = heading + behind;
  const double quickest = std::max(kMostTurned, space_->quickest_turn()),
               lacks = std::clamp(control.turn - tempo_ * playback.evident().turn, -quickest, quickest);
  return root_adjustment_ * unit * (lacks + std::clamp(behind / kHeading / unit, -kMostTurned, kMostTurned));
}

void PoseCorrection::adjust_tempo(const Control& control, const Control& evident, double seconds) {
  const double least = kMoving / space_->scale();
  const bool goes = evident.speed() > least && control.speed() > least && !evident.jumps();
  const double faster = goes ? std::sqrt(control.speed() / evident.speed()) : 1,
               wanted = 1 + root_adjustment_ * (std::clamp(faster, kSlowest, kFastest) - 1);
  tempo_ += filtered(seconds, kPacing) * (wanted - tempo_);
}

void PoseCorrection::adjust_root(const Control& control, double seconds, Playback& playback) {
  adjust_tempo(control, playback.evident_of_hips(), seconds);
  adjust_velocity(control, seconds, playback);
  turn_rate_ += filtered(seconds, kTurning) * (turn_to_add(control, playback, seconds) - turn_rate_);
  playback.move(velocity_, turn_rate_, seconds);
}

// What plays and what is added to it together get no faster from their velocity than a body can.
void PoseCorrection::adjust_velocity(const Control& control, double seconds, const Playback& playback) {
  const Vector2 hips = playback.velocity_of_hips(), played = tempo_ * hips,
                faster = (begins_ ? 0 : root_adjustment_) * (played - played_);
  played_ = played;
  begins_ = false;
  if (playback.is_in_the_air()) return;
  const Vector2 change = filtered(seconds, kLag) * (velocity_to_add(control, hips) - velocity_);
  velocity_ += clamp_length(change + faster, acceleration_ * seconds) - faster;
}

void PoseCorrection::leave_root(double seconds, Playback& playback) {
  tempo_ += filtered(seconds, kPacing) * (1 - tempo_);
  velocity_ -= clamp_length(filtered(seconds, kLag) * velocity_, acceleration_ * seconds);
  turn_rate_ -= filtered(seconds, kTurning) * turn_rate_;
  playback.move(velocity_, turn_rate_, seconds);
  target_heading_ = playback.frame().heading;
}

void PoseCorrection::correct(const Playback& playback, const Vector2& acceleration, double seconds) {
  const Skeleton& skeleton = workspace_->kinematics.skeleton();
  lean_.apply(skeleton, workspace_->shown, acceleration, seconds);
  edit_steps(playback.evident_of_hips(), seconds);
  if (lock_feet_) lock_feet(playback, seconds);
}

// A foot that stands goes back under the hips as fast as the fragment goes forward; by what the adjustment makes that
// faster or slower its place from the hips, which grows with the same time, must change. And the feet of a body that is
// accelerated are set where their push goes through it: behind one that gets faster, ahead of one that brakes.
void PoseCorrection::edit_steps(const Control& evident, double seconds) {
  const Vector2 velocity{evident.x, evident.y};
  const bool goes = evident.speed() * space_->scale() > kMoving;
  const Matrix2 wanted =
      goes ? Matrix2{velocity_ * velocity.transpose() / (tempo_ * velocity.squaredNorm())} : Matrix2{Matrix2::Zero()};
  steps_.stride += filtered(seconds, kStriding) * (wanted - steps_.stride);
  const Vector2 behind = -kSetOff * workspace_->shown.root.z() / kGravity * lean_.acceleration();
  steps_.shift += filtered(seconds, kStriding) * (behind - steps_.shift);
}

void PoseCorrection::lock_feet(const Playback& playback, double seconds) {
  const Contacts& contacts = playback.contacts();
  if (contacts.feet[0].empty()) return;
  foot_lock_.apply(workspace_->shown, contacts, playback.frame_of_clip(), seconds, steps_);
}

}  // namespace fragmotion

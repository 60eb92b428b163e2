// SPDX-License-Identifier: MIT
#include "runtime/pose_correction.hpp"

#include <algorithm>

#include "feet/standing_leg.hpp"
#include "motion/contacts.hpp"
#include "runtime/look_stitch.hpp"

namespace fragmotion {
[[gnu::cold]] PoseCorrection::PoseCorrection(const Character& character, Workspace& workspace, bool lock_feet)
    : workspace_(&workspace),
      scale_(character.space.scale()),
      lock_feet_(lock_feet),
      foot_lock_(workspace.body),
      lean_(workspace.trunk, workspace.body->legs, scale_, workspace.constants.lean) {}

void PoseCorrection::set_feet(bool lock, bool edit) {
  if (lock != lock_feet_) foot_lock_.reset();
  if (!edit) steps_ = {};
  lock_feet_ = lock;
  edit_steps_ = edit;
}

void PoseCorrection::reset() {
  steps_ = {};
  foot_lock_.reset();
  lean_.reset();
}

void PoseCorrection::correct(const Playback& playback, const RootGovernor& governor, bool even, double seconds) {
  const Skeleton& skeleton = workspace_->kinematics.skeleton();
  const Vector2 acceleration = edit_steps_ ? governor.acceleration() : Vector2::Zero();
  lean_.apply(skeleton, workspace_->shown, acceleration, playback.facing(), workspace_->follows(seconds));
  Footwork work;
  if (edit_steps_) work = edit_steps(playback.evident_of_hips(), governor, seconds);
  if (lock_feet_) lock_feet(playback, even, seconds, work);
}

// A foot that stands goes back under the hips as fast as the fragment goes forward; by what the root makes that faster
// or slower its place from the hips, which grows with the same time, must change. And the feet of a body that is
// accelerated are set where their push goes through it: behind one that gets faster, ahead of one that brakes.
Footwork PoseCorrection::edit_steps(const Control& evident, const RootGovernor& governor, double seconds) {
  const Vector2 velocity{evident.x, evident.y};
  const bool goes = evident.speed() * scale_ > kMoving;
  const Vector2 longer = governor.velocity() + (governor.pace() - governor.tempo()) * velocity;
  const Matrix2 wanted = goes ? Matrix2{longer * velocity.transpose() / (governor.tempo() * velocity.squaredNorm())}
                              : Matrix2{Matrix2::Zero()};
  const double longest = kTurnsAtMost - 1;  // of a step, as legs swing that much faster for it
  const double most = std::min(1.0, longest / std::max(longest, wanted.norm()));
  const double strode = workspace_->release(seconds);
  steps_.stride += strode * (most * wanted - steps_.stride);
  const Vector2 behind =
      -workspace_->constants.feet.ahead * workspace_->shown.root.z() / kGravity * lean_.acceleration();
  steps_.shift += strode * (behind - steps_.shift);
  const double pushes = scale_ * governor.acceleration().norm() / workspace_->constants.root.acceleration;
  return {governor.turn_rate(), goes ? std::min(1.0, pushes) : 0, !governor.rests()};
}

void PoseCorrection::lock_feet(const Playback& playback, bool even, double seconds, const Footwork& work) {
  const Contacts& contacts = playback.contacts();
  if (contacts.feet[0].empty()) return;
  const double loading = even ? kLoading : 0;
  const auto frame = [&](double later) { return playback.frame_of_clip(playback.seconds() + later); };
  foot_lock_.apply(workspace_->shown, contacts, {frame(0), frame(-loading), frame(loading)}, seconds, steps_, work);
}

}  // namespace fragmotion

// SPDX-License-Identifier: MIT
#include "runtime/root_governor.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/filtered.hpp"
#include "base/rounding.hpp"
#include "motion/contacts.hpp"

namespace fragmotion {
namespace {

constexpr double kSlowestSwing = 0.7;  // of the captured tempo: that at half the speed

// m/s^2: half at a responsiveness of 0, without a limit at 1.
double acceleration_of(const RootLimits& limits, double responsiveness, const ControlSpace& space) {
  return limits.acceleration / 2 / (1 - responsiveness) / space.scale();
}

}  // namespace

RootGovernor::RootGovernor(const Character& character, const RootLimits& limits, Filter& settles,
                           double root_adjustment, double responsiveness)
    : limits_(&limits),
      settles_(&settles),
      space_(&character.space),
      root_adjustment_(root_adjustment),
      limit_(acceleration_of(limits, responsiveness, character.space), character.space.turn_rate()) {}

void RootGovernor::set(double root_adjustment, double responsiveness) {
  root_adjustment_ = root_adjustment;
  limit_.set_acceleration(acceleration_of(*limits_, responsiveness, *space_));
}

void RootGovernor::reset(double heading) {
  limit_.reset(heading);
  acceleration_ = velocity_ = Vector2::Zero();
  begins_ = true;
  turn_rate_ = 0;
  tempo_ = quicker_ = 1;
  ahead_ = 0;
  target_heading_ = heading;
}

void RootGovernor::keep(const Vector2& faster, const Playback& playback) {
  const Vector2 kept = pace() * faster;
  velocity_ += kept;
  if (std::exchange(begins_, true) || kept.isZero()) return;
  const Vector2 begins = pace() * playback.mean_travel().velocity, goes = begins + velocity_,
                ripple = kept - (played_ - begins),
                fades = clamp_length(ripple, limit_.acceleration() * playback.left());
  const double commanded = limit_.velocity(playback.frame().heading).norm(),
               most = std::max({played_.norm(), begins.norm(), commanded}) + fades.norm();
  velocity_ += clamp_length(goes - ripple + fades, most) - goes;
}

void RootGovernor::steer(const Control& control, double seconds, Playback& playback) {
  const bool in_the_air = playback.is_in_the_air();
  const double heading = playback.frame().heading;
  acceleration_ = in_the_air ? Vector2::Zero() : limit_.advance(control, heading, seconds);
  const Control command = limit_.after(control, heading, limits_->settles);  // by which what is added lags behind
  const Travel mean = playback.mean_travel();
  steer_tempo(command, playback, seconds);
  const double settled = (*settles_)(seconds);
  steer_velocity(command, mean.velocity, in_the_air, settled, seconds);
  steer_turn(command.turn * space_->turn_rate(), mean.turn_rate, playback, settled, seconds);
  playback.move(velocity_, turn_rate_, seconds);
  steer_pace(playback, mean, settled, seconds);
}

void RootGovernor::steer_tempo(const Control& command, const Playback& playback, double seconds) {
  const Control& evident = playback.evident_of_hips();
  const bool goes = evident.speed() * space_->scale() > kMoving && space_->asks_to_go(command) && !evident.jumps();
  const double faster = goes ? std::sqrt(command.speed() / evident.speed()) : 1,
               wanted = 1 + root_adjustment_ * (std::min(faster, limits_->fastest) - 1);
  tempo_ += filtered(seconds, playback.step_seconds() / 2) * (wanted - tempo_);
}

// In the slowest of walks a leg swings little slower than in others; that the steps are slow is as both feet stand the
// longer (M. Murray et al., "Comparison of free and fast speed walking patterns", Am. J. Phys. Med. 63, 1984).
void RootGovernor::steer_pace(const Playback& playback, const Travel& mean, double settled, double seconds) {
  double wanted = 1;
  if (tempo_ < kSlowestSwing) {
    const BothStand both = playback.both_stand();
    const double swings = kSlowestSwing / tempo_, rests = both.lasts / std::max(both.lasts + ahead_, kRounding);
    if (both.begins >= 0) wanted = both.begins > 0 ? swings : std::min(swings, rests);
  }
  const double before = pace();
  quicker_ += settled * (wanted - quicker_);
  ahead_ = tempo_ < kSlowestSwing ? ahead_ + seconds * (pace() - tempo_) : 0;
  const double faster = pace() - before;
  velocity_ -= faster * mean.velocity;
  played_ += faster * mean.velocity;
  turn_rate_ -= faster * mean.turn_rate;
}

// The velocity that the strides lack, as far as they can be changed. Who stands may sway.
Vector2 RootGovernor::velocity_to_add(const Control& command, const Vector2& mean) const {
  if (command.speed() == 0 && mean.norm() * space_->scale() < limits_->sways) return Vector2::Zero();
  const Vector2 lacks = Vector2{command.x, command.y} - pace() * mean;
  return root_adjustment_ * clamp_length(lacks, limits_->stride * mean.norm());
}

// What plays and what is added to it together get no faster from their velocity than a body can.
void RootGovernor::steer_velocity(const Control& command, const Vector2& mean, bool in_the_air, double settled,
                                  double seconds) {
  const Vector2 played = pace() * mean, faster = (begins_ ? 0 : root_adjustment_) * (played - played_);
  played_ = played;
  begins_ = false;
  if (in_the_air) return;
  const Vector2 change = settled * (velocity_to_add(command, mean) - velocity_);
  velocity_ += clamp_length(change + faster, limit_.acceleration() * seconds) - faster;
}

// Draws the heading to that which is asked for, and turns little faster than is asked or than a control
// of these takes asks.
void RootGovernor::steer_turn(double asked, double mean, const Playback& playback, double settled, double seconds) {
  const double time = playback.step_seconds() / 2, most = kTurnsAtMost * std::max(std::abs(asked), space_->turn_rate()),
               heading = playback.frame().heading;
  target_heading_ += seconds * asked;
  const double behind = std::clamp(wrapped(target_heading_ - heading), -most * time, most * time);
  target_heading_ = heading + behind;
  const double wanted = root_adjustment_ * (std::clamp(asked + behind / time, -most, most) - pace() * mean);
  turn_rate_ += settled * (wanted - turn_rate_);
}

void RootGovernor::leave(double seconds, Playback& playback) {
  acceleration_ = Vector2::Zero();
  tempo_ += filtered(seconds, playback.step_seconds() / 2) * (1 - tempo_);
  quicker_ = 1;
  ahead_ = 0;
  const double settled = (*settles_)(seconds);
  velocity_ -= clamp_length(settled * velocity_, limit_.acceleration() * seconds);
  turn_rate_ -= settled * turn_rate_;
  playback.move(velocity_, turn_rate_, seconds);
  target_heading_ = playback.frame().heading;
}

}  // namespace fragmotion

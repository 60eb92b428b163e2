// SPDX-License-Identifier: MIT
#include "runtime/gaze.hpp"

#include <algorithm>
#include <cmath>

#include "base/rounding.hpp"
#include "motion/contacts.hpp"
#include "motion/trunk.hpp"
#include "runtime/look_stitch.hpp"

namespace fragmotion {
namespace {

constexpr double kTurnsIn =
    0.5;  // s: a person's head takes so long (W. Zangemeister, L. Stark, Exp. Neurology 77, 1982)
constexpr double kSeenAhead =
    1;  // s: walkers look where they are then (A. Patla, J. Vickers, Exp. Brain Research 148, 2003)
constexpr double kRightBehind = 0.75 * kPi;  // rad: from there on it is over the shoulder that was looked over already

}  // namespace

void Gaze::look(Look look, const Vector3& place) {
  begins_ = begins_ || look != look_;
  look_ = look;
  place_ = place;
}

Gaze::Seen Gaze::see() const {
  const Kinematics& kinematics = workspace_->kinematics;
  const int head = kinematics.skeleton().roles.head;
  const WorldPose& pose = workspace_->shown;
  PosedBones& posed = workspace_->body->posed;
  kinematics.world(pose.root, pose.rotations.data(), workspace_->head_chain, posed.heads.data(),
                   posed.rotations.data());
  const Quaternion& rotation = posed.rotations[head];
  return {posed.heads[head] + rotation * (kinematics.skeleton().tips[head] / 2), rotation, angles(rotation)};
}

// Where a head looks that is turned so in the world.
Gaze::Angles Gaze::angles(const Quaternion& rotation) const { return angles(rotation * workspace_->gaze.forward); }

Gaze::Angles Gaze::angles(const Vector3& way) const {
  return {wrapped(std::atan2(-way.x(), way.y()) - workspace_->shown.heading),
          std::atan2(way.z(), way.head<2>().norm())};
}

Gaze::Angles Gaze::towards(const Vector3& eyes) const {
  const Vector3 way = place_ - eyes;
  if (way.norm() < kFloatRounding) return wanted_;
  return within(angles(way));
}

Gaze::Angles Gaze::within(Angles angles) const {
  const GazeRange& range = workspace_->gaze;
  const bool behind = std::abs(angles[0]) > kRightBehind && wants_;
  if (std::abs(angles[0]) > range.turn) angles[0] = std::copysign(range.turn, behind ? wanted_[0] : angles[0]);
  angles[1] = std::clamp(angles[1], range.down, range.up);
  return angles;
}

std::optional<Gaze::Angles> Gaze::wanted(const Seen& seen, const Control& command, double turn_rate) const {
  if (look_ == Look::at) return towards(seen.eyes);
  const Vector2 velocity{command.x, command.y};
  const bool goes = velocity.norm() * workspace_->body->scale > kMoving;
  if (look_ == Look::as_captured || !(goes || command.turn != 0)) return std::nullopt;
  const double way = (goes ? std::atan2(-velocity.x(), velocity.y()) : 0) + kSeenAhead / 2 * command.turn * turn_rate;
  return std::abs(way) > kPi / 2 ? std::nullopt : std::optional(within({way, seen.angles[1]}));
}

double Gaze::fastest() const {
  return std::max(kFloatRounding, kTurnsAtMost * static_cast<double>(workspace_->fastest_looks.back()));
}

// What is shown is so far from what is wanted.
void Gaze::put_off(const Angles& shown, const Angles& wanted) {
  offset_[0].value = wrapped(shown[0] - wanted[0]);
  offset_[1].value = shown[1] - wanted[1];
}

// What is wanted is followed at once where it moves; where it is another, from what was shown. Returns where to look.
Gaze::Angles Gaze::advance(const Angles& wanted, bool begins, double seconds) {
  const double most = fastest() * seconds;
  const Angles shown = angles(head_), moved{wrapped(wanted[0] - wanted_[0]), wanted[1] - wanted_[1]};
  if (begins || moved.norm() > most) {
    put_off(shown, wanted);
    due_ = std::max(kTurnsIn, Approach::kPeak * std::hypot(offset_[0].value, offset_[1].value) / fastest());
  }
  for (Approach& offset : offset_) offset.advance(0, due_, seconds);
  due_ = std::max(0.0, due_ - seconds);
  const Angles way{wrapped(wanted[0] + offset_[0].value - shown[0]), wanted[1] + offset_[1].value - shown[1]};
  const Angles aim = shown + std::min(1.0, most / std::max(way.norm(), most)) * way;
  if (way.norm() > most) put_off(aim, wanted);
  wanted_ = wanted;
  return aim;
}

// How far the chest turns with a head that turns so.
double Gaze::chest_of(double turn) const {
  const GazeRange& range = workspace_->gaze;
  return range.turn > 0 ? range.chest / range.turn * wrapped(turn) : 0;
}

// Turns the spine's bones by as much each, and then neck and head so that they look `to`.
void Gaze::turn(double chest, const Angles& to) {
  const Skeleton& skeleton = workspace_->kinematics.skeleton();
  double* rotations = workspace_->shown.rotations.data();
  const auto turn_each = [&](const std::vector<int>& bones, const Vector3& axis, double angle) {
    for (const int b : bones) turn_bone(skeleton, b, axis, angle / static_cast<double>(bones.size()), rotations);
  };
  turn_each(workspace_->spine, Vector3::UnitZ(), chest);
  const Angles from = see().angles;
  const double heading = workspace_->shown.heading + to[0];
  turn_each(workspace_->look, Vector3::UnitZ(), wrapped(to[0] - from[0]));
  turn_each(workspace_->look, Vector3{std::cos(heading), std::sin(heading), 0}, to[1] - from[1]);
}

// Turns the head back by what it turned too far since it was shown last, be it about what it looks at; whether it did.
bool Gaze::hold_back(double seconds) {
  const Skeleton& skeleton = workspace_->kinematics.skeleton();
  const double most = fastest() * seconds;
  Seen seen = see();
  const Eigen::AngleAxisd way{seen.rotation * head_.conjugate()};
  const bool too_far = turned_ && way.angle() > most;
  if (too_far) {
    turn_bone(skeleton, skeleton.roles.head, way.axis(), most - way.angle(), workspace_->shown.rotations.data());
    seen = see();
  }
  head_ = seen.rotation;
  return too_far;
}

void Gaze::apply(const Control& command, double turn_rate, double seconds) {
  const Seen captured = see();
  if (!turned_) head_ = captured.rotation;
  const std::optional<Angles> elsewhere = wanted(captured, command, turn_rate);
  Angles wanted = elsewhere.value_or(captured.angles);
  double chest = 0;
  if (look_ == Look::at) {  // seen from where the eyes are of a head that is turned as it was
    const Angles was = angles(head_);
    chest = chest_of(was[0] - captured.angles[0]);
    turn(chest, was);
    wanted = towards(see().eyes);
  }
  const Angles aim = advance(wanted, begins_ || !turned_ || elsewhere.has_value() != wants_, seconds);
  begins_ = false;
  wants_ = elsewhere.has_value();
  turn(chest_of(aim[0] - captured.angles[0]) - chest, aim);
  const bool is_late = hold_back(seconds);
  turned_ = is_late || wants_ || !offset_[0].rests() || !offset_[1].rests();
}

}  // namespace fragmotion

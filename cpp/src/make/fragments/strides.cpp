// SPDX-License-Identifier: MIT
#include "fragments/strides.hpp"

#include <algorithm>
#include <cmath>

#include "control/control.hpp"
#include "motion/contacts.hpp"
#include "motion/pose.hpp"

namespace fragmotion {
namespace {

constexpr double kWidest = 0.2;  // m of a 1.8 m character that each foot is set out so as not to cross the other
constexpr double kLevel = 0.8;   // of the way to flat, where feet go straight to the side

}  // namespace

Strides::Strides(const Kinematics& kinematics, const Legs& legs, const GaitCycle& cycle, const GaitEdit& edit,
                 double rate)
    : kinematics_(kinematics), legs_(legs), edit_(edit), posed_(kinematics.bones()) {
  if (!exist()) return;
  for (const BodyPose& body : cycle.poses) {
    pose(body);
    for (int side = 0; side < count(); ++side) {
      middles_[side] += balls(side) / cycle.frames();
      find_flat(side, body);
    }
  }
  if (count() == kMostLegs) find_fore_change(cycle, rate);
  set_apart(cycle);
}

void Strides::change(BodyPose& body) {
  if (!exist()) return;
  pose(body);
  const double level = kLevel * std::abs(std::sin(sideways()));
  for (int side = 0; side < count(); ++side) {
    const Leg& leg = legs_[side];
    const Vector3 from = ball(kinematics_.skeleton(), leg, posed_);
    const Vector2 to = changed(side);
    const Quaternion foot = posed_.rotations[leg.foot], level_foot = foot.slerp(level, flat_[side].foot);
    const Vector3 arm = foot.conjugate() * (from - ankle_of(leg, posed_));
    turn_to(leg, level_foot, posed_);
    reach(kinematics_.skeleton(), leg, posed_, Vector3{to.x(), to.y(), from.z()} - level_foot * arm,
          body.rotations.data());
    if (leg.toe < 0) continue;
    double* toe = &body.rotations[std::size_t{4} * leg.toe];
    store_quaternion(load_quaternion(toe).slerp(level, flat_[side].toe), toe);
  }
}

void Strides::pose(const BodyPose& body) {
  kinematics_.world({0, 0, body.height}, body.rotations.data(), posed_.heads.data(), posed_.rotations.data());
}

Vector2 Strides::balls(int side) const { return ball(kinematics_.skeleton(), legs_[side], posed_).head<2>(); }

Vector2 Strides::changed(int side) const {
  const double apart = apart_[side / 2];
  const Vector2 outward{side % 2 == 0 ? -apart : apart, 0};
  const Vector2 stride = balls(side) - middles_[side];
  if (side >= 2) return middles_[side] + outward + fore_ * stride;
  return middles_[side] + outward + edit_.speed * turned(stride, sideways());
}

// What takes the velocity of the shoulders to the one that they get by the change of the path and by its turn.
void Strides::find_fore_change(const GaitCycle& cycle, double rate) {
  const Vector2 velocity = rate * cycle.mean_way(), hips = edit_.speed * turned(velocity, edit_.direction);
  if (velocity.norm() * standard_scale(kinematics_.skeleton()) < kMoving) {
    fore_ = edit_.speed * Eigen::Rotation2Dd(edit_.direction).toRotationMatrix();
    return;
  }
  Vector2 shoulders = Vector2::Zero();
  for (const BodyPose& body : cycle.poses) {
    pose(body);
    shoulders += (posed_.heads[legs_[2].thigh] + posed_.heads[legs_[3].thigh]).head<2>() / (2 * cycle.frames());
  }
  const Vector2 wanted = hips + edit_.turn * Vector2{-shoulders.y(), shoulders.x()};
  const double along = velocity.dot(wanted) / velocity.squaredNorm(),
               across = (velocity.x() * wanted.y() - velocity.y() * wanted.x()) / velocity.squaredNorm();
  fore_ << along, -across, across, along;
}

void Strides::find_flat(int side, const BodyPose& body) {
  const Leg& leg = legs_[side];
  const double height = ankle_of(leg, posed_).z() + ball(kinematics_.skeleton(), leg, posed_).z();
  if (height >= flat_[side].height) return;
  flat_[side] = {height, posed_.rotations[leg.foot], Quaternion::Identity()};
  if (leg.toe >= 0) flat_[side].toe = load_quaternion(&body.rotations[std::size_t{4} * leg.toe]);
}

// Finds how far each foot is to go outward for them to come no nearer to crossing than they did, or at most may.
void Strides::set_apart(const GaitCycle& cycle) {
  for (int left = 0; left < count(); left += 2) {
    const int right = left + 1;
    double least = std::numeric_limits<double>::infinity(), least_changed = least;
    for (const BodyPose& body : cycle.poses) {
      pose(body);
      least = std::min(least, balls(right).x() - balls(left).x());
      least_changed = std::min(least_changed, changed(right).x() - changed(left).x());
    }
    apart_[left / 2] = std::clamp((least - least_changed) / 2, 0.0, kWidest / standard_scale(kinematics_.skeleton()));
  }
}

}  // namespace fragmotion

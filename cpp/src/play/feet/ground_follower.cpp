// SPDX-License-Identifier: MIT
#include "feet/ground_follower.hpp"

#include <algorithm>
#include <cmath>

#include "base/filtered.hpp"
#include "base/turn_between.hpp"
#include "feet/standing_leg.hpp"

namespace fragmotion {
namespace {

constexpr double kSky = 1e5;       // m: over all ground
constexpr int kAsked = 8;          // times that a step asks for the ground,
constexpr int kAskedAtFirst = 80;  // and a reset

Quaternion turned_by(const Vector2& slope) {
  if (slope.isZero(0)) return Quaternion::Identity();
  return turn_between(Vector3::UnitZ(), Vector3{-slope.x(), -slope.y(), 1});
}

}  // namespace

[[gnu::cold]] void GroundFollower::reset() {
  feet_ = {};
  hips_ = {};
  fresh_ = appears_ = true;
  exact_ = level_ = missed_ = 0;
}

void GroundFollower::forget_ground() {
  for (FootOnGround& foot : feet_) foot.forget_ground();
}

// What asks for the ground: from a step's height over where it is.
GroundProbe GroundFollower::probe(const WorldPose& pose) const {
  const double highest = kHighestStep / body_->scale;
  GroundProbe probe(ground_, level_ + highest, appears_ ? kAskedAtFirst : kAsked, 1 / body_->scale);
  if (!fresh_) return probe;
  const std::optional<GroundPoint> near = probe.ask(pose.root.head<2>());
  if (near && near->normal.z() > 0) return probe;
  probe.look_from(kSky);
  const std::optional<GroundPoint> top = probe.ask(pose.root.head<2>());
  probe.look_from(top ? top->height + highest : highest);
  return probe;
}

// The foot that stands, or lands first, asks first. Returns whether there is ground for both.
bool GroundFollower::advance_feet(const FeetAhead& feet, double seconds, GroundProbe& probe) {
  const int first = feet[1].due < feet[0].due ? 1 : 0;
  bool found = true;
  for (const int side : {first, 1 - first}) {
    const int spared = side == first ? FootOnGround::kAsksAtLeast : 0;
    found = feet_[side].advance(feet[side], lower(side, feet[side]), seconds, probe, spared) && found;
  }
  return found;
}

void GroundFollower::apply(WorldPose& pose, const FeetAhead& feet, double seconds) {
  GroundProbe probe = this->probe(pose);
  appears_ = false;
  auto& [constants, kinematics, legs, scale, leg_bones, bones, posed, filters] = *body_;
  if (!legs[0].exists() || !legs[1].exists()) return follow_hips(pose, seconds, probe);
  if (!advance_feet(feet, seconds, probe)) missed_ += seconds;
  get_exact(feet, seconds);
  hips_.advance(pose.root.head<2>(), feet_, seconds);
  level_ = hips_.level();
  pose.root.z() += level_;
  const double since = fresh_ ? kLookedAhead : seconds;
  fresh_ = false;
  if (is_flat()) return;
  kinematics.world_below(pose.root, pose.rotations.data(), bones, posed.heads.data(), posed.rotations.data());
  std::array<Vector3, 2> ankles{place_foot(0, feet[0]), place_foot(1, feet[1])};
  sink(feet, ankles, since);
  lower_hips(hips_.sunk(), pose.root, posed);
  std::array<Reach, 2> within;
  for (int side = 0; side < 2; ++side) {
    raise_heel(side, ankles[side]);
    unfold(side, ankles[side]);
    turn_foot(kinematics.skeleton(), legs[side], heels_[side] * turns_[side], turns_[side], posed,
              pose.rotations.data());
    within[side] = {shortest(legs[side], posed), longest(legs[side], posed)};
  }
  reach(kinematics.skeleton(), {&legs[0], &legs[1]}, posed, ankles, pose.rotations.data(), within.data());
}

// Feet stand exactly on ground that is not level: the less level, the more, so that rounding of its faces is not seen.
void GroundFollower::get_exact(const FeetAhead& feet, double seconds) {
  double lowest = feet_[0].last().height, highest = lowest, steepest = 0;
  for (const FootOnGround& foot : feet_) {
    for (const Footing* footing : {&foot.last(), &foot.next()}) {
      lowest = std::min(lowest, footing->height);
      highest = std::max(highest, footing->height);
      steepest = std::max(steepest, footing->slope.norm());
    }
  }
  const double uneven = highest - lowest + steepest * (feet[0].now.tip - feet[0].now.heel).norm();
  const double wanted = std::clamp(uneven * body_->scale / kUneven, 0.0, 1.0), most = fresh_ ? 1 : seconds / kLoading;
  exact_ += std::clamp(wanted - exact_, -most, most);
}

// How much lower than captured a foot is shown, m: one that is low comes down to its floor, softly.
double GroundFollower::lower(int side, const FootAhead& foot) const {
  const double height = foot.now.height();
  return exact_ * feet_[side].weight() * (height - softly_over(height, kLanding / body_->scale));
}

// Whether the body stands as on level ground.
bool GroundFollower::is_flat() const {
  const auto level = [&](const FootOnGround& foot) {
    return foot.height() == level_ && foot.slope().isZero(0) && foot.shift().isZero(0);
  };
  return level(feet_[0]) && level(feet_[1]) && exact_ == 0 && hips_.sunk() == 0;
}

void GroundFollower::follow_hips(WorldPose& pose, double seconds, GroundProbe& probe) {
  const std::optional<Footing> under = probe.at(pose.root.head<2>());
  if (!under) missed_ += seconds;
  const double wanted = under ? under->height : level_;
  level_ += (fresh_ ? 1 : filtered(seconds, 1 / kHipsFollow)) * (wanted - level_);
  fresh_ = false;
  pose.root.z() += level_;
}

// Where the foot's head is to be: the ball stays over its place.
Vector3 GroundFollower::place_foot(int side, const FootAhead& foot) {
  const Leg& leg = body_->legs[side];
  const FootOnGround& placed = feet_[side];
  turns_[side] = turned_by(placed.slope());
  const Vector3 from = ball(body_->kinematics.skeleton(), leg, body_->posed);
  const Vector2 over = from.head<2>() + placed.shift();
  const Vector3 to = Vector3{over.x(), over.y(), placed.height() + foot.now.ball.z() - lower(side, foot)} +
                     turns_[side] * Vector3{0, 0, foot.floor.ball};
  return to + turns_[side] * (ankle_of(leg, body_->posed) - from);
}

// Lowers the hips for legs that bear the body, and for those that are about to.
void GroundFollower::sink(const FeetAhead& feet, const std::array<Vector3, 2>& ankles, double seconds) {
  const double deepest = kHighestStep / body_->scale;
  double now = 0, soon = 0, due = kLookedAhead;
  for (int side = 0; side < 2; ++side) {
    const Leg& leg = body_->legs[side];
    const double length = kHipsReach * leg_length(leg, body_->posed),
                 lacks = too_high(length, body_->posed.heads[leg.thigh], ankles[side]);
    now = std::max(now, feet_[side].weight() * lacks);
    if (feet[side].stands || feet[side].due > due) continue;
    const FootAhead& foot = feet[side];
    const Footing& next = feet_[side].next();
    const Vector2 shifted = foot.ankle.head<2>() + next.place - foot.landing().place();
    const Vector3 hip = foot.hip + Vector3{0, 0, level_between(feet_, foot.hips.head<2>())},
                  ankle{shifted.x(), shifted.y(), foot.ankle.z() + next.at(shifted)};
    soon = std::max(0.0, too_high(length, hip, ankle));
    due = foot.due;
  }
  hips_.sink(std::min(exact_ * now, deepest), std::min(exact_ * soon, deepest), due, body_->constants.release, seconds);
}

// Raises the heel, and the ankle with it, about the ball where the leg is too short still.
void GroundFollower::raise_heel(int side, Vector3& ankle) {
  const Leg& leg = body_->legs[side];
  const PosedBones& posed = body_->posed;
  heels_[side] = Quaternion::Identity();
  const Vector3 from_ball = turns_[side] * (ankle_of(leg, posed) - ball(body_->kinematics.skeleton(), leg, posed)),
                ball = ankle - from_ball;
  const double most = kHighestHeel * exact_ * feet_[side].weight(),
               lacks = rise_to_reach(posed.heads[leg.thigh] - ball, from_ball, kHipsReach * leg_length(leg, posed));
  heels_[side] = heel_turn(std::min(lacks, most), from_ball);
  ankle = ball + heels_[side] * from_ball;
}

// Lowers a foot on its way that comes nearer to its hip than its leg folds up, or over it: onto the bell under the hip
// that touches the sphere of that from below, where it goes by without a kink.
void GroundFollower::unfold(int side, Vector3& ankle) const {
  const Leg& leg = body_->legs[side];
  const PosedBones& posed = body_->posed;
  const double least = shortest(leg, posed);
  const auto too_high = [&](const Vector3& at) {
    const Vector3 way = at - posed.heads[leg.thigh];
    return std::max(0.0, way.z() + least * std::exp(-way.head<2>().squaredNorm() / (2 * least * least)));
  };
  ankle.z() -= (1 - feet_[side].weight()) * std::max(0.0, too_high(ankle) - too_high(ankle_of(leg, posed)));
}

}  // namespace fragmotion

// SPDX-License-Identifier: MIT
#include "feet/foot_lock.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/filtered.hpp"
#include "base/rounding.hpp"
#include "feet/standing_leg.hpp"
#include "motion/pose.hpp"
#include "motion/skate.hpp"

namespace fragmotion {
namespace {

constexpr double kSoftGround = 0.006;  // m of a character of 1.8 m: a foot sinks in at most half of that

// The other foot of a pair.
int other(int side) { return side ^ 1; }

// How high a foot is at least that goes so fast: where nothing is seen of a slide, if it is faster than one that
// stands.
double clear_at(double speed) { return kSkateHeight * std::min(1.0, speed / kStandingSpeed); }

}  // namespace

StepEdit StepEdit::in_world(double heading) const {
  const Matrix2 turn = PlaneTurn(heading).matrix();
  return {turn * stride * turn.transpose(), turn * shift};
}

[[gnu::cold]] FootLock::Body::Body(const Kinematics& kinematics, const Legs& legs, const FeetConstants& constants)
    : constants(constants),
      kinematics(kinematics),
      legs(legs),
      scale(standard_scale(kinematics.skeleton())),
      bones(kinematics.chains({legs[0].foot, legs[0].toe, legs[1].foot, legs[1].toe, legs[2].foot, legs[2].toe,
                               legs[3].foot, legs[3].toe})),
      posed(kinematics.bones()) {
  for (int side = 0; side < legs.count(); ++side)
    leg_bones[side] = kinematics.chains({legs[side].foot, legs[side].toe});
}

void FootLock::Body::Filters::set(double time, const FeetConstants& constants) {
  if (seconds == time) return;
  seconds = time;
  rests = std::exp(-seconds / constants.rests);
  settles = filtered(seconds, kSettles);
  sinks = filtered(seconds, constants.sinks);
  returns = std::exp(-constants.returns() * seconds);
}

FootLock::FootLock(const Kinematics& kinematics, const Legs& legs)
    : FootLock(std::make_shared<Body>(kinematics, legs)) {}

FootLock::FootLock(std::shared_ptr<Body> body) : body_(std::move(body)), feet_(std::max(2, body_->legs.count())) {
  reset();
}

void FootLock::reset() {
  Foot free;
  free.free = body_->constants.release;
  std::fill(feet_.begin(), feet_.end(), free);
  sunk_ = stood_ = 0;
  fresh_ = true;
}

void FootLock::lock(Foot& foot, const Vector2& shown, double seconds) const {
  foot.locked = true;
  foot.stood = 0;
  foot.held = fresh_ ? shown : foot.shown;
  foot.drift = seconds > 0 && !fresh_ ? Vector2{(shown - foot.shown) / seconds - (1 - foot.holds) * foot.speed}
                                      : Vector2::Zero();
}

void FootLock::settle(bool settles, double seconds) {
  const auto free = std::count_if(feet_.begin(), feet_.end(), [](const Foot& foot) { return !foot.locked; });
  stood_ = settles && free == 0 ? stood_ + seconds : 0;
  if (stood_ >= body_->constants.release) step_out();
}

// A body that has come to stand does not stay in the middle of a stride or a turn.
[[gnu::cold]] void FootLock::step_out() {
  const double turned = body_->constants.astray / (kTurnsInHip / 2);  // so far is one whose hip is turned half way
  const auto astray = [&](const Foot& foot) {
    return (foot.held - foot.moved).norm() * body_->scale + turned * std::abs(foot.turn);
  };
  Foot& foot = *std::max_element(feet_.begin(), feet_.end(),
                                 [&](const Foot& a, const Foot& b) { return astray(a) < astray(b); });
  if (astray(foot) < body_->constants.astray) return;
  release(foot, foot.held - foot.moved);
  foot.steps = true;
}

Vector2 FootLock::coming_to_rest(int side) const {
  const Foot& foot = feet_[side];
  return foot.locked ? Vector2{body_->constants.rests * foot.drift} : Vector2::Zero();
}

double FootLock::stepping(int side) const {
  const Foot& foot = feet_[side];
  return foot.steps ? std::max(0.0, body_->constants.release - foot.free) : 0;
}

// The height of a foot that steps to where its motion has it.
double FootLock::step_height(const Foot& foot) const {
  const FeetConstants& constants = body_->constants;
  if (!foot.steps || foot.free >= constants.release) return 0;
  const double phase = foot.free / constants.release;
  return 4 * phase * (1 - phase) * constants.step / body_->scale;
}

// How much too high a foot is, or too low: where the hips are too high for what plays, its motion would let a planted
// one hover; where a stitch brings a foot away from a stand, it would let it cross the floor.
double FootLock::hovers(const Foot& foot, double over, double ball, double clear) const {
  if (foot.locked) return std::max(0.0, over - body_->constants.hovers / body_->scale);
  return std::min(0.0, std::max(0.0, ball) + step_height(foot) - clear);
}

double FootLock::lowered(Foot& foot, double over, double hovers) const {
  foot.lowered += body_->filters.settles * (hovers - foot.lowered);
  return std::min(foot.lowered, std::max(0.0, over));
}

// Of a planted foot that is left behind further than the leg is long the heel rises about the ball.
void FootLock::raise_heel(int side, const Vector3& ball, double longest, Vector3& ankle, double* rotations) {
  Foot& foot = feet_[side];
  const Leg& leg = body_->legs[side];
  PosedBones& posed = body_->posed;
  const Vector3 from_ball = ankle - ball, hip = posed.heads[leg.thigh] - ball;
  const double lacks = foot.locked ? rise_to_reach(hip, from_ball, longest) : 0;
  foot.raised += body_->filters.settles * (std::min(lacks, kHighestHeel) - foot.raised);
  if (foot.raised < kFloatRounding) return;
  const Quaternion turn = heel_turn(foot.raised, from_ball);
  ankle = ball + turned(turn, from_ball);
  turn_foot(body_->kinematics.skeleton(), leg, turn, Quaternion::Identity(), posed, rotations);
}

[[gnu::noinline]] void FootLock::release(Foot& foot, const Vector2& away) const {
  foot.locked = false;
  foot.steps = away.norm() * body_->scale > body_->constants.astray;
  foot.held = away;
  foot.drift -= foot.holds * foot.speed;
  foot.free = 0;
}

// How far the foot is shown from where its motion has it.
Vector2 FootLock::away(int side, const Vector2& moved, bool planted, double seconds) {
  const FeetConstants& constants = body_->constants;
  Foot& foot = feet_[side];
  foot.speed = seconds > 0 && !fresh_ ? Vector2{(moved - foot.moved) / seconds} : Vector2::Zero();
  foot.moved = moved;
  foot.free += seconds;
  Vector2 away = Vector2::Zero();
  if (!foot.locked && foot.free < kUnseen * constants.release) {
    const Vector2 rate = foot.drift + constants.returns() * foot.held;
    away = std::exp(-constants.returns() * foot.free) * (foot.held + foot.free * rate);
  }
  const bool stepping = foot.steps && foot.free < constants.release;
  const double too_far = foot.locked && feet_[other(side)].locked ? constants.too_far : constants.alone;
  if (planted && !foot.locked && !stepping && away.norm() * body_->scale < constants.too_far)
    lock(foot, moved + away, seconds);
  if (foot.locked) {
    foot.held += (1 - foot.holds) * seconds * foot.speed + constants.rests * (1 - body_->filters.rests) * foot.drift;
    foot.drift *= body_->filters.rests;
    away = foot.held - moved;
    if (!planted || away.norm() * body_->scale > too_far) release(foot, away);
  }
  foot.shown = moved + away;
  return away;
}

// The ball of a foot rolls off as fast as its motion lifts it, and comes down where that sets it: as much as what
// slides counts so high over the ground.
double FootLock::holds(int side, const Contacts& contacts, const Frames& frames, double height, double seconds) const {
  if (fresh_ || seconds == 0 || frames.before == frames.after) return 1;
  const double rises = (height - feet_[side].height) / seconds;
  if (rises > 0) return contacts.stands(side, frames.after) ? 1 : std::max(0.0, 1 - rises * body_->scale / kLeaves);
  return contacts.stands(side, frames.before) ? 1 : skate_weight(height * body_->scale);
}

// The leg turns in its hip while the body turns over a planted foot.
void FootLock::hold_turn(int side, double seconds) {
  Foot& foot = feet_[side];
  const Leg& leg = body_->legs[side];
  const Vector3 across = turned(body_->posed.rotations[leg.foot], leg.across);
  const double faces = std::atan2(across.y(), across.x()), before = foot.stood > 0 ? foot.faces : faces;
  const double by = foot.holds * wrapped(faces - before);
  foot.turn = std::clamp(foot.turn - by, -kTurnsInHip, kTurnsInHip);
  foot.turn_speed = seconds > 0 ? -by / seconds : 0;
  foot.faces = faces;
  foot.stood += seconds;
}

// A foot that swings gets to where it is turned to the one side as far as it will be to the other.
void FootLock::return_turn(int side, double rate, double seconds) {
  Foot& foot = feet_[side];
  const double ahead = std::clamp(rate * std::min(foot.stood, kLookedAhead) / 2, -kTurnsInHip, kTurnsInHip);
  const double returns = body_->constants.returns(), off = foot.turn - ahead, speed = foot.turn_speed + returns * off;
  foot.turn = ahead + body_->filters.returns * (off + seconds * speed);
  foot.turn_speed = body_->filters.returns * (foot.turn_speed - returns * seconds * speed);
}

// What a foot's steps are seen from: the hips, or the middle between the fore legs.
Vector3 FootLock::under(int side, const WorldPose& pose) const {
  if (side < 2) return pose.root;
  return (body_->posed.heads[body_->legs[2].thigh] + body_->posed.heads[body_->legs[3].thigh]) / 2;
}

void FootLock::apply(WorldPose& pose, const Contacts& contacts, const Frames& frames, double seconds,
                     const StepEdit& edit, const Footwork& work) {
  auto& [constants, kinematics, legs, scale, leg_bones, bones, posed, filters] = *body_;
  const int count = legs.count();
  if (count == 0) return;
  filters.set(seconds, constants);
  const Skeleton& skeleton = kinematics.skeleton();
  kinematics.world_below(pose.root, pose.rotations.data(), bones, posed.heads.data(), posed.rotations.data());
  const StepEdit steps = edit.in_world(pose.heading);
  std::array<Vector3, kMostLegs> ankles;
  double strained = 0;
  settle(work.settles, seconds);
  for (int side = 0; side < count; ++side) {
    const Vector3 place = ball(skeleton, legs[side], posed), ankle = ankle_of(legs[side], posed);
    const FootHeights& floor = contacts.floors[side];
    const double height = place.z() - floor.ball, over = std::min(height, ankle.z() - floor.heel);
    const bool locked = feet_[side].locked, low = over * scale < kLanding;
    const bool hands_over = locked && contacts.stands(other(side), frames.now) && !feet_[other(side)].locked;
    const bool stands = hands_over || (contacts.stands(side, frames.now) && (locked || low));
    const bool outlasts = hands_over && !contacts.stands(side, frames.now);
    feet_[side].holds = outlasts ? 1 : holds(side, contacts, frames, height, seconds);
    feet_[side].height = height;
    const Vector2 edited = steps.moved((place - under(side, pose)).head<2>());
    const Vector2 before = feet_[side].shown, held = away(side, place.head<2>() + edited, stands, seconds),
                  by = edited + held;
    const double speed = fresh_ || seconds == 0 ? 0 : (feet_[side].shown - before).norm() / seconds;
    const double hovers = this->hovers(feet_[side], over, height, work.clears * clear_at(speed * scale) / scale);
    const double lift =
        softly_over(-over, kSoftGround / scale) + step_height(feet_[side]) - lowered(feet_[side], over, hovers);
    const Vector3 moved{by.x(), by.y(), lift};
    if (feet_[side].locked)
      hold_turn(side, seconds);
    else
      return_turn(side, work.turn, seconds);
    const PlaneTurn half(feet_[side].turn / 2);
    ankles[side] = ankle + moved;
    ankles[side].head<2>() += half.twice() * Vector2{(ankle - place).head<2>()} - (ankle - place).head<2>();
    turn_leg(legs[side], leg_bones[side], half, posed);
    const double most = longest(legs[side], posed);
    raise_heel(side, place + moved, most, ankles[side], pose.rotations.data());
    if (by.isZero(kRounding) && lift == 0 && feet_[side].turn == 0) continue;
    const double strain = std::max(0.0, too_high(most, posed.heads[legs[side].thigh], ankles[side]));
    if (feet_[side].locked && strain * scale > constants.strained) release(feet_[side], held);
    strained = std::max(strained, std::min(constants.strained / scale, strain));
  }
  fresh_ = false;
  sunk_ += (strained - sunk_) * filters.sinks;
  pose.root.z() -= sunk_;
  for (int side = 0; side < count; ++side) ankles[side].z() += sunk_;  // seen from hips that have not sunk
  for (int side = 0; side < count; side += 2) {
    reach(skeleton, {&legs[side], &legs[side + 1]}, posed, {ankles[side], ankles[side + 1]}, pose.rotations.data());
  }
}

}  // namespace fragmotion

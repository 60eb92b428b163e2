// SPDX-License-Identifier: MIT
#include "runtime/reaching.hpp"

#include <algorithm>
#include <cmath>

namespace fragmotion {
namespace {

constexpr double kHeard = 0.1;      // s: what is told little by little is told so often at least
constexpr double kReachesIn = 0.6;  // s of a whole reach (T. Flash, N. Hogan, J. Neuroscience 5, 1985)
constexpr double kHandSpeed = 2;    // m/s at the most, of a 1.8 m character whose hand goes to another place (there)
// Of an arm's length: from where the trunk helps (L. Mark et al., J. Exp. Psychology: HPP 23, 1997); and from where to
// where a hand gives up what is too far away.
constexpr double kHelps = 0.9, kGivesUp = 1.4, kGone = 2.2;
constexpr double kSoftly = 0.1;               // of an arm's length, within which the trunk begins to help
constexpr double kMostLean = 20 * kPi / 180;  // a quarter of what trunks bend (AAOS, Joint Motion, 1965)
constexpr double kBehind = 30 * kPi / 180;    // beyond what a shoulder lets reach: within it a hand gives up
constexpr double kNoWay = 1e-6;               // m

// 1 up to `begin`, 0 from `end` on.
double fading(double value, double begin, double end) { return 1 - ease_in_ease_out((value - begin) / (end - begin)); }

Vector3 upright(double turning, const Vector3& from) { return {-turning * from.y(), turning * from.x(), 0}; }

}  // namespace

void Reaching::Hand::set(const Vector3& value, const Vector3& speed) {
  for (int i = 0; i < 3; ++i) place[i] = {value[i], speed[i]};
}

void Reaching::reach(int side, const HandAim& aim) {
  Hand& hand = hands_[side];
  const double heard = std::min(hand.since, kHeard);
  if (hand.rests()) {
    hand.set(aim.place, Vector3::Zero());
    hand.place_due = 0;
  } else if (aim.carried != hand.aim.carried) {
    convert(hand, aim.carried);
    hand.place_due = kReachesIn;
  } else if (aim.place != hand.aim.place) {
    const double way = (aim.place - hand.at()).norm() * workspace_->body->scale;
    hand.place_due = std::max(heard, Approach::kPeak * way / kHandSpeed);
  }
  if (aim.weight != hand.aim.weight)
    hand.weight_due = std::max(heard, kReachesIn * std::abs(aim.weight - hand.weight.value));
  hand.aim = aim;
  hand.since = 0;
}

// The place that is followed goes on as it goes, seen from the other space.
void Reaching::convert(Hand& hand, bool carried) const {
  const Vector3 level{0, 0, level_}, goes{speed_.x(), speed_.y(), 0}, at{frame_.position.x(), frame_.position.y(), 0};
  const Quaternion turned = frame_.rotation();
  if (carried) {
    const Vector3 seen = frame_.to_local(hand.at() - level);
    hand.set(seen, turned.conjugate() * (hand.speed() - goes - upright(turning_, hand.at() - at)));
  } else {
    const Vector3 place = frame_.to_world(hand.at()) + level;
    hand.set(place, turned * hand.speed() + goes + upright(turning_, place - at));
  }
}

void Reaching::follow_frame(double level, double seconds) {
  const WorldPose& pose = workspace_->shown;
  const CharacterFrame before = frame_;
  frame_ = {pose.root.head<2>(), pose.heading};
  level_ = level;
  speed_ = seconds > 0 ? Vector2((frame_.position - before.position) / seconds) : Vector2::Zero();
  turning_ = seconds > 0 ? wrapped(frame_.heading - before.heading) / seconds : 0;
}

void Reaching::see() const {
  PosedBones& posed = workspace_->body->posed;
  workspace_->kinematics.world(workspace_->shown.root, workspace_->shown.rotations.data(), workspace_->arm_chains,
                               posed.heads.data(), posed.rotations.data());
}

Vector3 Reaching::world_place(const Hand& hand) const {
  return hand.aim.carried ? Vector3(frame_.to_world(hand.at()) + Vector3{0, 0, level_}) : hand.at();
}

// Where the palm is to be; none where it stays.
std::optional<Reaching::Goal> Reaching::goal(int side) const {
  const Hand& hand = hands_[side];
  const auto& [arm, widest] = workspace_->arms[side];
  if (!arm.exists() || hand.rests()) return std::nullopt;
  const Skeleton& skeleton = workspace_->kinematics.skeleton();
  const PosedBones& posed = workspace_->body->posed;
  const Vector3 place = world_place(hand), way = place - posed.heads[arm.upper];
  const double away = way.norm() / arm_length(skeleton, arm, posed);
  const double along = way.norm() > kNoWay ? way.normalized().dot(frame_.rotation() * forward_aside(side)) : 1,
               angle = std::acos(std::clamp(along, -1.0, 1.0));
  const double weight =
      std::clamp(hand.weight.value, 0.0, 1.0) * fading(away, kGivesUp, kGone) * fading(angle, widest, widest + kBehind);
  if (weight <= 0) return std::nullopt;
  const Vector3 captured = palm(skeleton, arm, posed);
  return Goal{captured + weight * (place - captured), weight};
}

// Leans the trunk to what arms are too short for; whether it did.
bool Reaching::lean(const Goals& goals) const {
  const Skeleton& skeleton = workspace_->kinematics.skeleton();
  const PosedBones& posed = workspace_->body->posed;
  if (workspace_->trunk.base < 0) return false;
  Vector3 turn = Vector3::Zero();
  for (int side = 0; side < 2; ++side) {
    if (!goals[side]) continue;
    const Arm& arm = workspace_->arms[side].arm;
    const double length = arm_length(skeleton, arm, posed);
    const Vector3 from = posed.heads[arm.upper] - posed.heads[workspace_->trunk.base],
                  way = goals[side]->place - posed.heads[arm.upper];
    const double over = way.norm() - kHelps * length;
    if (over <= 0 || from.norm() < kNoWay) continue;
    const double eased = over * over / (over + kSoftly * length);
    const double angle = kMostLean * (1 - std::exp(-eased / (kMostLean * from.norm())));
    turn += goals[side]->weight * angle * from.normalized().cross(way.normalized());
  }
  const double angle = turn.norm();
  if (angle <= 0) return false;
  turn_spine(skeleton, workspace_->trunk, turn / angle, std::min(angle, kMostLean), workspace_->shown.rotations.data());
  return true;
}

void Reaching::apply(double level, double seconds) {
  follow_frame(level, seconds);
  for (Hand& hand : hands_) {
    hand.since += seconds;
    if (hand.rests()) continue;
    for (int i = 0; i < 3; ++i) hand.place[i].advance(hand.aim.place[i], hand.place_due, seconds);
    hand.weight.advance(hand.aim.weight, hand.weight_due, seconds);
    hand.place_due = std::max(0.0, hand.place_due - seconds);
    hand.weight_due = std::max(0.0, hand.weight_due - seconds);
  }
  if (hands_[0].rests() && hands_[1].rests()) return;
  see();
  const Goals goals{goal(0), goal(1)};
  if (lean(goals)) see();
  const Vector3 halfway = frame_.rotation() * Vector3{0, 1, -1};
  for (int side = 0; side < 2; ++side) {
    if (!goals[side]) continue;
    fragmotion::reach(workspace_->kinematics.skeleton(), workspace_->arms[side].arm, workspace_->body->posed,
                      goals[side]->place, goals[side]->weight, halfway, workspace_->shown.rotations.data());
  }
}

}  // namespace fragmotion

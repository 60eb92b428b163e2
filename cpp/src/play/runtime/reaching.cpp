// SPDX-License-Identifier: MIT
#include "runtime/reaching.hpp"

#include <algorithm>
#include <cmath>

#include "base/rounding.hpp"
#include "control/control.hpp"

namespace fragmotion {
namespace {

constexpr double kReachesIn = 0.6;  // s of a whole reach (T. Flash, N. Hogan, J. Neuroscience 5, 1985)
constexpr double kHandSpeed = 2;    // m/s at the most, of a 1.8 m character whose hand goes to another place (there)
// Of an arm's length: from where the trunk helps (L. Mark et al., J. Exp. Psychology: HPP 23, 1997); and from where to
// where a hand gives up what is too far away.
constexpr double kHelps = 0.9, kGivesUp = 1.4, kGone = 2.2;
constexpr double kMostLean = 20 * kPi / 180;  // a quarter of what trunks bend (AAOS, Joint Motion, 1965)
constexpr double kBehind = 30 * kPi / 180;    // beyond what a shoulder lets reach: within it a hand gives up
// rad/s: twice as fast as a whole reach at its fastest, from beside the body to over the head, and as fast as a lean.
constexpr double kArmSpeed = 2 * Approach::kPeak * kPi / kReachesIn,
                 kLeanSpeed = Approach::kPeak * kMostLean / kReachesIn;

// 1 up to `begin`, 0 from `end` on.
double fading(double value, double begin, double end) { return 1 - ease_in_ease_out((value - begin) / (end - begin)); }

Vector3 upright(double turning, const Vector3& from) { return {-turning * from.y(), turning * from.x(), 0}; }

}  // namespace

void Reaching::Hand::set(const Vector3& value, const Vector3& speed) {
  for (int i = 0; i < 3; ++i) place[i] = {value[i], speed[i]};
}

Quaternion Reaching::Turn::shown() const {
  const Vector3 off{offset[0].value, offset[1].value, offset[2].value};
  const double angle = off.norm();
  return angle > 0 ? Quaternion{Eigen::AngleAxisd{angle, off / angle}} * wanted : wanted;
}

// What goes on faster than an arm turns is caught up with.
void Reaching::Turn::follow(const Quaternion& next, double seconds) {
  const Eigen::AngleAxisd way{next * wanted.conjugate()};
  const double most = kArmSpeed * seconds;
  if (way.angle() > most) {
    const Eigen::AngleAxisd off{Eigen::AngleAxisd{most, way.axis()} * shown() * next.conjugate()};
    for (int i = 0; i < 3; ++i) offset[i].value = off.angle() * off.axis()[i];
    due = kReachesIn;
  }
  wanted = next;
  for (Approach& part : offset) part.advance(0, due, seconds);
  due = std::max(0.0, due - seconds);
}

void Reaching::reach(int side, const HandAim& aim) {
  Hand& hand = hands_[side];
  const double heard = std::min(hand.since, kControlStep);
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
  idles_ = false;
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
  const double along = way.norm() > kFloatRounding ? way.normalized().dot(frame_.rotation() * forward_aside(side)) : 1,
               angle = std::acos(std::clamp(along, -1.0, 1.0));
  const double weight =
      std::clamp(hand.weight.value, 0.0, 1.0) * fading(away, kGivesUp, kGone) * fading(angle, widest, widest + kBehind);
  if (weight <= 0) return std::nullopt;
  const Vector3 captured = palm(skeleton, arm, posed);
  return Goal{captured + weight * (place - captured), weight};
}

// By what the trunk leans to what arms are too short for: an axis, as long as the angle is, rad.
Vector3 Reaching::wanted_lean(const Goals& goals) const {
  const Skeleton& skeleton = workspace_->kinematics.skeleton();
  const PosedBones& posed = workspace_->body->posed;
  Vector3 turn = Vector3::Zero();
  for (int side = 0; side < 2; ++side) {
    if (!goals[side]) continue;
    const Arm& arm = workspace_->arms[side].arm;
    const double length = arm_length(skeleton, arm, posed);
    const Vector3 from = posed.heads[arm.upper] - posed.heads[workspace_->trunk.base],
                  way = goals[side]->place - posed.heads[arm.upper];
    const double over = way.norm() - kHelps * length;
    if (over <= 0 || from.norm() < kFloatRounding) continue;
    const double eased = over * over / (over + (1 - kHelps) * length);
    const double angle = kMostLean * (1 - std::exp(-eased / (kMostLean * from.norm())));
    turn += goals[side]->weight * angle * from.normalized().cross(way.normalized());
  }
  const double angle = turn.norm();
  return angle > kMostLean ? Vector3(kMostLean / angle * turn) : turn;
}

// Leans the trunk; whether it did.
bool Reaching::lean(const Goals& goals, double seconds) {
  if (workspace_->trunk.base < 0) return false;
  const Vector3 wanted = frame_.rotation().conjugate() * wanted_lean(goals), way = wanted - lean_;
  const double most = kLeanSpeed * seconds;
  lean_ = way.norm() > most ? Vector3(lean_ + most / way.norm() * way) : wanted;
  const double angle = lean_.norm();
  if (angle <= 0) return false;
  turn_spine(workspace_->kinematics.skeleton(), workspace_->trunk, frame_.rotation() * lean_ / angle, angle,
             workspace_->shown.rotations.data());
  return true;
}

// Brings an arm to its goal, or back to how it is captured.
void Reaching::bend(int side, const std::optional<Goal>& goal, double seconds) {
  const Arm& arm = workspace_->arms[side].arm;
  Hand& hand = hands_[side];
  if (!goal && hand.hangs()) return;
  const std::array<int, 2> bones{arm.upper, arm.elbow};
  const auto rotation = [&](int i) { return workspace_->shown.rotations.data() + std::ptrdiff_t{4} * bones[i]; };
  const std::array<Quaternion, 2> captured{load_quaternion(rotation(0)), load_quaternion(rotation(1))};
  if (goal) {
    fragmotion::reach(workspace_->kinematics.skeleton(), arm, workspace_->body->posed, goal->place, goal->weight,
                      frame_.rotation() * Vector3{0, 1, -1}, workspace_->shown.rotations.data());
  }
  for (int i = 0; i < 2; ++i) {
    const Quaternion wanted = goal ? load_quaternion(rotation(i)) * captured[i].conjugate() : Quaternion::Identity();
    hand.turns[i].follow(wanted, seconds);
    if (hand.turns[i].is_off()) store_quaternion((hand.turns[i].shown() * captured[i]).normalized(), rotation(i));
  }
}

void Reaching::apply(double level, double seconds) {
  follow_frame(level, seconds);
  if (idles_) return;
  for (Hand& hand : hands_) {
    hand.since = std::min(hand.since + seconds, kControlStep);
    if (hand.rests()) continue;
    for (int i = 0; i < 3; ++i) hand.place[i].advance(hand.aim.place[i], hand.place_due, seconds);
    hand.weight.advance(hand.aim.weight, hand.weight_due, seconds);
    hand.place_due = std::max(0.0, hand.place_due - seconds);
    hand.weight_due = std::max(0.0, hand.weight_due - seconds);
  }
  const auto idles = [](const Hand& hand) { return hand.rests() && hand.hangs(); };
  if (idles(hands_[0]) && idles(hands_[1]) && lean_.isZero(0)) {
    idles_ = std::min(hands_[0].since, hands_[1].since) == kControlStep;
    return;
  }
  see();
  const Goals goals{goal(0), goal(1)};
  if (lean(goals, seconds)) see();
  for (int side = 0; side < 2; ++side) bend(side, goals[side], seconds);
}

}  // namespace fragmotion

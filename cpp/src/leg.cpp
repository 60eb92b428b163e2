// SPDX-License-Identifier: MIT
#include "fragmotion/leg.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace fragmotion {
namespace {

constexpr double kStretched = 0.995;  // of a leg's length: what it reaches at most, unless it does already
constexpr double kSoft = 0.03;        // of a leg's length, below that: where it follows less
constexpr double kStraight = 0.1;     // rad: a knee that is bent less than that resists being bent backward
constexpr double kFolded = 2.5;       // rad: a knee that is bent more resists, too
constexpr double kNear = 0.02;  // of a leg's length: wanted so near to where it is, a foot may go as the knee does
constexpr int kApart = 5;       // frames of the clips that are looked at: each fifth

constexpr double kTires = kStretched - kSoft;  // of a leg's length: from where it follows less

double softly(double distance) {
  return distance < kTires ? distance : kTires + kSoft * (1 - std::exp((kTires - distance) / kSoft));
}

// How far apart the ends of a leg come that are `now` apart and would be `wanted`, all in lengths of the leg. Where
// they are wanted as they are, they stay.
double apart(double now, double wanted) {
  if (wanted <= kTires) return wanted;
  const double share = now > kTires ? std::min(1.0, (wanted - kTires) / (now - kTires)) : 0;
  return std::min(softly(wanted) + share * (now - softly(now)), std::max(now, kStretched));
}

// A knee's bend, which neither goes backward nor folds up the leg: a stitch may overshoot.
double bearable(double bend) {
  if (bend < -kPi / 2) bend += 2 * kPi;  // it is folded further than flat, rather than bent backward
  if (bend > kFolded) return kFolded + kStraight * (1 - std::exp((kFolded - bend) / kStraight));
  return bend > kStraight ? bend : kStraight * std::exp(bend / kStraight - 1);
}

// The angle of the knee, 0 where the leg is straight, for which its ends are so far apart.
double opening(double upper, double lower, double apart) {
  return std::acos(std::clamp((apart * apart - upper * upper - lower * lower) / (2 * upper * lower), -1.0, 1.0));
}

Leg leg_of(const Skeleton& skeleton, int thigh, int foot, int toe) {
  if (thigh < 0 || foot < 0 || !skeleton.is_below(foot, thigh)) return {};
  std::vector<Vector3> heads;
  std::vector<Quaternion> rotations;
  rest_pose(skeleton, heads, rotations);
  const Vector3 left = heads[skeleton.roles.left_thigh] - heads[skeleton.roles.right_thigh];
  Leg leg{thigh, -1, foot, toe, skeleton.parents[foot], rotations[thigh].conjugate() * left.normalized()};
  double most = 0;
  for (int b = leg.above_foot; b != thigh && b >= 0; b = skeleton.parents[b]) {
    const double shorter = std::min((heads[b] - heads[thigh]).norm(), (heads[foot] - heads[b]).norm());
    if (shorter > most) most = shorter, leg.knee = b;
  }
  return leg;
}

// What bends the leg's knee in a pose, as the thigh sees it; the longer the more it is bent.
Vector3 bend(const Leg& leg, const PosedBones& posed) {
  const Vector3 upper = posed.heads[leg.knee] - posed.heads[leg.thigh],
                lower = posed.heads[leg.foot] - posed.heads[leg.knee];
  return posed.rotations[leg.thigh].conjugate() * upper.cross(lower) / (upper.norm() * lower.norm());
}

}  // namespace

Legs find_legs(const Kinematics& kinematics, const std::vector<Clip>& clips) {
  const Skeleton& skeleton = kinematics.skeleton();
  const Roles& roles = skeleton.roles;
  Legs legs{leg_of(skeleton, roles.left_thigh, roles.left_foot, roles.left_toe),
            leg_of(skeleton, roles.right_thigh, roles.right_foot, roles.right_toe)};
  if (!legs[0].exists() || !legs[1].exists()) return legs;
  PosedBones posed(kinematics.bones());
  for (const Clip& clip : clips) {
    for (int f = 0; f < clip.frames; f += kApart) {
      kinematics.world(clip, f, posed.heads.data(), posed.rotations.data());
      for (Leg& leg : legs) leg.hinge += bend(leg, posed);
    }
  }
  for (Leg& leg : legs) leg.hinge.normalize();
  return legs;
}

Vector3 ball(const Skeleton& skeleton, const Leg& leg, const PosedBones& posed) {
  if (leg.toe >= 0) return posed.heads[leg.toe];
  return posed.heads[leg.foot] + posed.rotations[leg.foot] * skeleton.tips[leg.foot];
}

double sinking(const Leg& leg, const PosedBones& posed, const Vector3& ankle) {
  const Vector3 &hip = posed.heads[leg.thigh], &knee = posed.heads[leg.knee], &foot = posed.heads[leg.foot];
  const double length = kStretched * ((knee - hip).norm() + (foot - knee).norm());
  const Vector3 way = ankle - hip;
  const double square = length * length - way.head<2>().squaredNorm();
  if (square <= 0) return std::numeric_limits<double>::infinity();
  return std::max(0.0, -way.z() - std::sqrt(square));
}

void reach(const Skeleton& skeleton, const Leg& leg, const PosedBones& posed, const Vector3& ankle, double* rotations) {
  const Vector3 hip = posed.heads[leg.thigh], upper = posed.heads[leg.knee] - hip,
                lower = posed.heads[leg.foot] - posed.heads[leg.knee];
  const double length = upper.norm() + lower.norm(), now = (upper + lower).norm() / length;
  const Vector3 hinge = posed.rotations[leg.thigh] * leg.hinge;
  const Vector3 axis = (hinge - hinge.dot(upper) / upper.squaredNorm() * upper).normalized();
  const double across = (lower - lower.dot(axis) * axis).norm(), beside = lower.squaredNorm() - across * across;
  const auto angle = [&](double distance) {
    return opening(upper.norm(), across, std::sqrt(std::max(0.0, distance * distance - beside)));
  };
  const auto distance = [&](double bend) {
    const double in_plane = upper.squaredNorm() + across * across + 2 * upper.norm() * across * std::cos(bend);
    return std::sqrt(in_plane + beside) / length;
  };
  const double bent = std::atan2(axis.dot(upper.cross(lower)), upper.dot(lower)), natural = distance(bearable(bent));
  double wanted = (ankle - hip).norm() / length;
  wanted += std::max(0.0, 1 - std::abs(wanted - now) / kNear) * (natural - now);
  const Quaternion knee{Eigen::AngleAxisd(angle(length * apart(natural, wanted)) - bent, axis)};
  const Quaternion thigh = Quaternion::FromTwoVectors(upper + knee * lower, ankle - hip), shin = thigh * knee;
  const auto store = [&](int bone, const Quaternion& parent, const Quaternion& world) {
    store_quaternion((parent.conjugate() * world).normalized(), rotations + std::ptrdiff_t{4} * bone);
  };
  const auto above = [&](int bone) { return posed.rotations[skeleton.parents[bone]]; };
  store(leg.thigh, above(leg.thigh), thigh * posed.rotations[leg.thigh]);
  store(leg.knee, thigh * above(leg.knee), shin * posed.rotations[leg.knee]);
  store(leg.foot, shin * above(leg.foot), posed.rotations[leg.foot]);
}

}  // namespace fragmotion

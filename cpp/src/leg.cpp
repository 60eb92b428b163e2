// SPDX-License-Identifier: MIT
#include "fragmotion/leg.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace fragmotion {
namespace {

constexpr double kStretched = 0.98;  // of a leg's length
constexpr double kHinge = 0.1;       // a leg less bent than this (sine) bends to the front, whatever its angle

// The axis about which the knee bends: that of its bend, or, where it hardly bends, the character's left. At right
// angles to the thigh.
Vector3 hinge(const Vector3& upper, const Vector3& lower, double heading) {
  const Vector3 left{-std::cos(heading), -std::sin(heading), 0};
  const Vector3 bend = upper.cross(lower) + kHinge * upper.norm() * lower.norm() * left;
  return (bend - bend.dot(upper) / upper.squaredNorm() * upper).normalized();
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
  Leg leg{thigh, -1, foot, toe, skeleton.parents[foot]};
  double most = 0;
  for (int b = leg.above_foot; b != thigh && b >= 0; b = skeleton.parents[b]) {
    const double shorter = std::min((heads[b] - heads[thigh]).norm(), (heads[foot] - heads[b]).norm());
    if (shorter > most) most = shorter, leg.knee = b;
  }
  return leg;
}

}  // namespace

Leg left_leg(const Skeleton& skeleton) {
  const Roles& roles = skeleton.roles;
  return leg_of(skeleton, roles.left_thigh, roles.left_foot, roles.left_toe);
}

Leg right_leg(const Skeleton& skeleton) {
  const Roles& roles = skeleton.roles;
  return leg_of(skeleton, roles.right_thigh, roles.right_foot, roles.right_toe);
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

void reach(const Skeleton& skeleton, const Leg& leg, const PosedBones& posed, const Vector3& ankle, double heading,
           double* rotations) {
  const Vector3 hip = posed.heads[leg.thigh], upper = posed.heads[leg.knee] - hip,
                lower = posed.heads[leg.foot] - posed.heads[leg.knee];
  const double longest = std::max((upper + lower).norm(), kStretched * (upper.norm() + lower.norm()));
  const Vector3 axis = hinge(upper, lower, heading);
  const double across = (lower - lower.dot(axis) * axis).norm(), beside = lower.squaredNorm() - across * across;
  const auto angle = [&](double apart) {
    return opening(upper.norm(), across, std::sqrt(std::max(0.0, apart * apart - beside)));
  };
  const double wanted = std::min((ankle - hip).norm(), longest);
  const Quaternion knee{Eigen::AngleAxisd(angle(wanted) - angle((upper + lower).norm()), axis)};
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

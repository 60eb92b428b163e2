// SPDX-License-Identifier: MIT
#include "feet/standing_leg.hpp"

#include <algorithm>
#include <cmath>

namespace fragmotion {
namespace {

// About which a heel rises.
Vector3 heel_axis(const Vector3& from_ball) { return from_ball.cross(Vector3::UnitZ()).normalized(); }

}  // namespace

double softly_over(double over, double soft) {
  if (over < 0) return 0;
  return over < soft ? over * over / (2 * soft) : over - soft / 2;
}

double too_high(double length, const Vector3& hip, const Vector3& ankle) {
  const Vector3 way = ankle - hip;
  return -way.z() - std::sqrt(std::max(0.0, length * length - way.head<2>().squaredNorm()));
}

[[gnu::cold]] Quaternion heel_turn(double angle, const Vector3& from_ball) {
  return Quaternion{Eigen::AngleAxisd(angle, heel_axis(from_ball))};
}

double rise_to_reach(const Vector3& hip, const Vector3& from_ball, double length) {
  const double along = -dot(hip, from_ball),
               wanted = (length * length - hip.squaredNorm() - from_ball.squaredNorm()) / 2;
  if (along <= wanted) return 0;
  const double across = -dot(hip, heel_axis(from_ball).cross(from_ball));
  if (across >= 0) return 0;
  return std::atan2(across, along) + std::acos(std::max(-1.0, wanted / std::hypot(along, across)));
}

void turn_leg(const Leg& leg, const std::vector<int>& bones, const PlaneTurn& half, PosedBones& posed) {
  const auto [c, s] = half;
  const PlaneTurn turn = half.twice();
  const Vector2 hip = posed.heads[leg.thigh].head<2>();
  for (const int bone : bones) {
    if (bone < leg.thigh) continue;
    const Vector2 from_hip = posed.heads[bone].head<2>() - hip;
    posed.heads[bone].head<2>() = hip + turn * from_hip;
    Quaternion& q = posed.rotations[bone];
    q = {c * q.w() - s * q.z(), c * q.x() - s * q.y(), c * q.y() + s * q.x(), c * q.z() + s * q.w()};
  }
}

void turn_foot(const Skeleton& skeleton, const Leg& leg, const Quaternion& foot, const Quaternion& toe,
               PosedBones& posed, double* rotations) {
  if (leg.toe >= 0) {
    const Quaternion above = product(foot, posed.rotations[skeleton.parents[leg.toe]]);
    store_quaternion(rounded_off(product(above.conjugate(), product(toe, posed.rotations[leg.toe]))),
                     rotations + std::ptrdiff_t{4} * leg.toe);
  }
  turn_to(leg, product(foot, posed.rotations[leg.foot]), posed);
}

void lower_hips(double by, Vector3& root, PosedBones& posed) {
  root.z() -= by;
  for (Vector3& head : posed.heads) head.z() -= by;
}

}  // namespace fragmotion

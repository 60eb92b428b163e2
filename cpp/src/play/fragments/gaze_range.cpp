// SPDX-License-Identifier: MIT
#include "fragments/gaze_range.hpp"

#include <algorithm>
#include <cmath>

#include "base/quantile.hpp"
#include "motion/trunk.hpp"
#include "skeleton/kinematics.hpp"

namespace fragmotion {
namespace {

// rad that a head looks aside, down and up without effort: half of what necks turn actively (J. Youdas et al., Physical
// Therapy 72, 1992: 70, 55 and 75 degrees at 20 to 30 years). Takes in which nobody looks about tell no more.
constexpr double kAside = 35 * kPi / 180, kDown = 27.5 * kPi / 180, kUp = 37.5 * kPi / 180;

}  // namespace

void Turned::add(const Quaternion& seen) { all_.emplace_back(seen.cast<float>()); }

Vector3 Turned::forward() const {
  Vector3 sum = Vector3::Zero();
  for (const Eigen::Quaternionf& seen : all_) sum += seen.cast<double>().conjugate() * Vector3::UnitY();
  return sum.norm() > 0 ? sum.normalized() : Vector3::UnitY();
}

std::vector<double> Turned::turns(const Vector3& direction) const {
  std::vector<double> angles;
  for (const Eigen::Quaternionf& seen : all_) {
    const Vector3 looks = seen.cast<double>() * direction;
    angles.push_back(std::abs(std::atan2(-looks.x(), looks.y())));
  }
  return angles;
}

std::vector<double> Turned::pitches(const Vector3& direction) const {
  std::vector<double> angles;
  for (const Eigen::Quaternionf& seen : all_) {
    const Vector3 looks = seen.cast<double>() * direction;
    angles.push_back(std::atan2(looks.z(), looks.head<2>().norm()));
  }
  return angles;
}

GazeRanges::GazeRanges(const Skeleton& skeleton) : head_(skeleton.roles.head) {
  if (const Trunk trunk(skeleton); trunk.head >= 0) chest_ = trunk.chest;
}

void GazeRanges::add(double heading, const std::vector<Quaternion>& world) {
  const Quaternion back = CharacterFrame{{}, -heading}.rotation();
  if (chest_ >= 0) chest_turned_.add(back * world[chest_]);
  head_turned_.add(back * world[head_]);
}

GazeRange GazeRanges::range() const {
  GazeRange range;
  if (head_turned_.empty()) return range;
  range.forward = head_turned_.forward();
  const std::vector<double> pitches = head_turned_.pitches(range.forward);
  range.turn = std::max(kAside, quantile(head_turned_.turns(range.forward), kUsualShare));
  range.down = std::min(-kDown, quantile(pitches, 1 - kUsualShare));
  range.up = std::max(kUp, quantile(pitches, kUsualShare));
  if (chest_ >= 0) {
    range.chest = std::min(range.turn, quantile(chest_turned_.turns(chest_turned_.forward()), kUsualShare));
  }
  return range;
}

}  // namespace fragmotion

// SPDX-License-Identifier: MIT
#include "fragments/arm_range.hpp"

#include <algorithm>
#include <cmath>

#include "base/quantile.hpp"
#include "motion/pose.hpp"

namespace fragmotion {
namespace {

// rad from forward_aside(): what shoulders do easily, arms that hang back, up, and a third past the middle included
// (of 180 degrees of flexion and abduction, 60 of extension and 45 past the middle: American Academy of Orthopaedic
// Surgeons, Joint Motion, 1965).
constexpr double kEasyArms = 100 * kPi / 180;

// What bends a straight arm forward from the rest pose, as the upper arm sees it.
Vector3 forward_hinge(const Kinematics& kinematics, const Arm& arm) {
  const Skeleton& skeleton = kinematics.skeleton();
  PosedBones rest(skeleton.size());
  rest_pose(skeleton, rest.heads, rest.rotations);
  const Vector3 forward = kinematics.rest_frame().rotation() * Vector3::UnitY(),
                upper = (rest.heads[arm.elbow] - rest.heads[arm.upper]).normalized(), axis = upper.cross(forward);
  return rest.rotations[arm.upper].conjugate() * (axis.norm() > kBends ? axis.normalized() : upper.unitOrthogonal());
}

// Reads poses for how arms are held in them.
class ArmReader {
 public:
  ArmReader(const Skeleton& skeleton, const std::array<ArmRange, 2>& ranges)
      : kinematics_(skeleton), ranges_(&ranges), rotations_(std::size_t{4} * skeleton.size()), posed_(skeleton.size()) {
    std::vector<int> hands;
    for (const ArmRange& range : ranges) {
      if (range.arm.exists()) hands.push_back(range.arm.hand);
    }
    chains_ = kinematics_.chains(hands);
  }

  void read(const PackedClip& clip, double frame) {
    const RootPose root = sample_pose(clip, frame, clip.grid->bones, rotations_.data());
    kinematics_.world_below(root.place, rotations_.data(), chains_, posed_.heads.data(), posed_.rotations.data());
    const Quaternion facing = root.frame().rotation();
    for (int side = 0; side < 2; ++side) {
      const Arm& arm = (*ranges_)[side].arm;
      if (arm.exists()) add(side, arm, facing);
    }
  }

  void tell(std::array<ArmRange, 2>& ranges) const {
    for (int side = 0; side < 2; ++side) {
      if (angles_[side].empty()) continue;
      const Vector3 hinge = hinges_[side] / static_cast<double>(angles_[side].size());
      ranges[side].arm.hinge =
          hinge.norm() > kBends ? hinge.normalized() : forward_hinge(kinematics_, ranges[side].arm);
      ranges[side].widest = std::max(kEasyArms, quantile(angles_[side], kUsualShare));
    }
  }

 private:
  void add(int side, const Arm& arm, const Quaternion& facing) {
    const Vector3 hand = palm(kinematics_.skeleton(), arm, posed_), way = hand - posed_.heads[arm.upper],
                  upper = posed_.heads[arm.elbow] - posed_.heads[arm.upper];
    const Vector3 lower = hand - posed_.heads[arm.elbow];
    hinges_[side] += posed_.rotations[arm.upper].conjugate() * upper.normalized().cross(lower.normalized());
    const double along = way.normalized().dot(facing * forward_aside(side));
    angles_[side].push_back(std::acos(std::clamp(along, -1.0, 1.0)));
  }

  Kinematics kinematics_;
  const std::array<ArmRange, 2>* ranges_;
  std::vector<double> rotations_;
  PosedBones posed_;
  std::vector<int> chains_;
  std::array<Vector3, 2> hinges_{Vector3::Zero(), Vector3::Zero()};
  std::array<std::vector<double>, 2> angles_;
};

}  // namespace

Vector3 forward_aside(int side) { return {(side == 0 ? -1 : 1) * std::sqrt(0.5), std::sqrt(0.5), 0}; }

std::array<ArmRange, 2> arm_ranges(const std::vector<const PackedPool*>& pools) {
  const Skeleton& skeleton = pools.front()->skeleton;
  std::array<ArmRange, 2> ranges;
  const std::array<Arm, 2> arms = resting_arms(skeleton);
  for (int side = 0; side < 2; ++side) ranges[side].arm = arms[side];
  if (!arms[0].exists() && !arms[1].exists()) return ranges;
  ArmReader reader(skeleton, ranges);
  for (const PackedPool* pool : pools) {
    for (const Fragment& f : pool->fragments) {
      if (f.origin == Origin::captured) reader.read(pool->clips[f.clip], f.first_played());
    }
  }
  reader.tell(ranges);
  return ranges;
}

}  // namespace fragmotion

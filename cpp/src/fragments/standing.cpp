// SPDX-License-Identifier: MIT
#include "fragmotion/fragments/standing.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "fragments/body_pose.hpp"
#include "fragmotion/motion/pose.hpp"

namespace fragmotion {
namespace {

constexpr double kAsHigh = 0.985;                // of a leg's length: how far the hip joints stand over the ankles
constexpr double kOutward = 8 * kPi / 180;       // rad that each foot points outward
constexpr std::size_t kFewest = 10, kShare = 5;  // fragments at least, and one of how many, that are the slowest

std::vector<int> slowest_of(const FragmentPool& pool) {
  std::vector<int> slowest(pool.fragments.size());
  for (std::size_t i = 0; i < slowest.size(); ++i) slowest[i] = static_cast<int>(i);
  std::stable_sort(slowest.begin(), slowest.end(),
                   [&](int a, int b) { return pool.fragments[a].evident.speed() < pool.fragments[b].evident.speed(); });
  slowest.resize(std::min(slowest.size(), std::max(kFewest, slowest.size() / kShare)));
  return slowest;
}

// A foot as it stands flat: where it got lowest.
struct FlatFoot {
  double height = std::numeric_limits<double>::infinity();                     // m, of ankle and ball together
  double ankle = 0;                                                            // m over the ground
  Quaternion rotation = Quaternion::Identity(), toe = Quaternion::Identity();  // in the world; the toe's of its own
};

// Gathers poses, each seen from its character frame, into the one that stands.
class Stance {
 public:
  Stance(const Kinematics& kinematics, const Legs& legs)
      : kinematics_(kinematics), legs_(legs), posed_(kinematics.bones()) {}

  void add(const BodyPose& body) {
    pose(body);
    if (mean_.rotations.empty()) mean_.rotations.resize(body.rotations.size(), 0);
    for (std::size_t b = 0; b < body.rotations.size(); b += 4) add_rotation(&body.rotations[b], &mean_.rotations[b]);
    mean_.height += body.height;
    floor_ += lowest_tip();
    ++count_;
    if (!has_legs()) return;
    for (int side = 0; side < 2; ++side) add_foot(side, body);
  }

  BodyPose result() {
    for (std::size_t b = 0; b < mean_.rotations.size(); b += 4) {
      store_quaternion(load_quaternion(&mean_.rotations[b]).normalized(), &mean_.rotations[b]);
    }
    mean_.height /= count_;
    if (has_legs()) {
      stand_on_feet();
    } else {
      pose(mean_);
      mean_.height += floor_ / count_ - lowest_tip();
    }
    return mean_;
  }

 private:
  bool has_legs() const { return legs_[0].exists() && legs_[1].exists(); }

  void pose(const BodyPose& body) {
    kinematics_.world({0, 0, body.height}, body.rotations.data(), posed_.heads.data(), posed_.rotations.data());
  }

  double lowest_tip() const {
    double lowest = std::numeric_limits<double>::infinity();
    for (const int b : measured_bones(kinematics_.skeleton())) {
      lowest = std::min(lowest, (posed_.heads[b] + posed_.rotations[b] * kinematics_.skeleton().tips[b]).z());
    }
    return lowest;
  }

  void add_foot(int side, const BodyPose& body) {
    const Leg& leg = legs_[side];
    const double ankle = posed_.heads[leg.foot].z();
    const double height = ankle + ball(kinematics_.skeleton(), leg, posed_).z();
    FlatFoot& flat = feet_[side];
    if (height >= flat.height) return;
    flat = {height, ankle, posed_.rotations[leg.foot], Quaternion::Identity()};
    if (leg.toe >= 0) flat.toe = load_quaternion(&body.rotations[std::size_t{4} * leg.toe]);
  }

  // The foot turned about the vertical to point forward, and a little outward.
  Quaternion pointing(int side) const {
    const Leg& leg = legs_[side];
    const Vector3 arm =
        posed_.rotations[leg.foot].conjugate() * (ball(kinematics_.skeleton(), leg, posed_) - posed_.heads[leg.foot]);
    const Vector3 points = feet_[side].rotation * arm;
    const double off = std::atan2(-points.x(), points.y()), wanted = side == 0 ? kOutward : -kOutward;
    return Quaternion{Eigen::AngleAxisd(wanted - off, Vector3::UnitZ())} * feet_[side].rotation;
  }

  double length(const Leg& leg) const {
    return (posed_.heads[leg.knee] - posed_.heads[leg.thigh]).norm() +
           (posed_.heads[leg.foot] - posed_.heads[leg.knee]).norm();
  }

  void stand_on_feet() {
    pose(mean_);
    double lift = std::numeric_limits<double>::infinity();
    for (int side = 0; side < 2; ++side) {
      const Leg& leg = legs_[side];
      lift = std::min(lift, feet_[side].ankle + kAsHigh * length(leg) - posed_.heads[leg.thigh].z());
    }
    mean_.height += lift;
    pose(mean_);
    for (int side = 0; side < 2; ++side) {
      const Leg& leg = legs_[side];
      const Vector3 hip = posed_.heads[leg.thigh];
      posed_.rotations[leg.foot] = pointing(side);
      reach(kinematics_.skeleton(), leg, posed_, {hip.x(), hip.y(), feet_[side].ankle}, mean_.rotations.data());
      if (leg.toe >= 0) store_quaternion(feet_[side].toe, &mean_.rotations[std::size_t{4} * leg.toe]);
    }
  }

  const Kinematics& kinematics_;
  const Legs& legs_;
  PosedBones posed_;
  BodyPose mean_;
  std::array<FlatFoot, 2> feet_;
  double floor_ = 0, count_ = 0;  // m, summed; poses
};

}  // namespace

Clip standing(const Kinematics& kinematics, const Legs& legs, const FragmentPool& pool, int frames, double rate) {
  Stance stance(kinematics, legs);
  for (const int i : slowest_of(pool)) {
    const Fragment& fragment = pool.fragments[i];
    const Clip& clip = pool.clips[fragment.clip];
    for (int f = fragment.begin; f < fragment.end; ++f) stance.add(body_pose(kinematics, clip, f));
  }
  const BodyPose pose = stance.result();
  Clip clip;
  clip.name = "standing";
  clip.rate = rate;
  while (clip.frames < frames) append(kinematics, clip, {}, pose);
  return clip;
}

}  // namespace fragmotion

// SPDX-License-Identifier: MIT
#include "fragments/standing.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/random.hpp"
#include "feet/standing_leg.hpp"
#include "fragments/body_pose.hpp"
#include "motion/pose.hpp"
#include "motion/trunk.hpp"

namespace fragmotion {
namespace {

constexpr double kOutward = 8 * kPi / 180;  // rad that each foot points outward
// Root mean squares of how a body moves that stands for long; m of a 1.8 m character.
constexpr double kAcross = 0.015, kAlong = 0.008;
constexpr double kLean = 1 * kPi / 180, kLook = 6 * kPi / 180, kNod = 1.5 * kPi / 180;  // rad
constexpr double kBreath = 3.6;                                                         // s
constexpr double kDepth = 1.2 * kPi / 180;                                              // rad that the chest goes back
constexpr double kUneven = 0.15;                 // of a breath, by which it comes sooner or later
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
      : kinematics_(kinematics),
        legs_(legs),
        measured_(measured_bones(kinematics.skeleton())),
        posed_(kinematics.bones()) {}

  void add(const BodyPose& body) {
    pose(body);
    if (mean_.rotations.empty()) mean_.rotations.resize(body.rotations.size(), 0);
    for (std::size_t b = 0; b < body.rotations.size(); b += 4) add_rotation(&body.rotations[b], &mean_.rotations[b]);
    mean_.height += body.height;
    ++count_;
    if (is_upright()) {
      for (int side = 0; side < 2; ++side) add_foot(side, body);
    } else {
      floor_ += lowest_tip();
    }
  }

  BodyPose result() {
    for (std::size_t b = 0; b < mean_.rotations.size(); b += 4) {
      store_quaternion(load_quaternion(&mean_.rotations[b]).normalized(), &mean_.rotations[b]);
    }
    mean_.height /= count_;
    if (is_upright()) {
      stand_on_feet();
    } else {
      pose(mean_);
      mean_.height += floor_ / count_ - lowest_tip();
    }
    return mean_;
  }

 private:
  // On two legs, which bodies stretch to stand; those on four legs stand with them bent.
  bool is_upright() const { return legs_.count() == 2; }

  void pose(const BodyPose& body) {
    kinematics_.world({0, 0, body.height}, body.rotations.data(), posed_.heads.data(), posed_.rotations.data());
  }

  double lowest_tip() const {
    double lowest = std::numeric_limits<double>::infinity();
    for (const int b : measured_) {
      lowest = std::min(lowest, (posed_.heads[b] + posed_.rotations[b] * kinematics_.skeleton().tips[b]).z());
    }
    return lowest;
  }

  void add_foot(int side, const BodyPose& body) {
    const Leg& leg = legs_[side];
    const double low = ankle_of(leg, posed_).z();
    const double height = low + ball(kinematics_.skeleton(), leg, posed_).z();
    FlatFoot& flat = feet_[side];
    if (height >= flat.height) return;
    flat = {height, low, posed_.rotations[leg.foot], Quaternion::Identity()};
    if (leg.toe >= 0) flat.toe = load_quaternion(&body.rotations[std::size_t{4} * leg.toe]);
  }

  // The foot turned about the vertical to point forward, and a little outward.
  Quaternion pointing(int side) const {
    const Leg& leg = legs_[side];
    const Vector3 arm =
        posed_.rotations[leg.foot].conjugate() * (ball(kinematics_.skeleton(), leg, posed_) - ankle_of(leg, posed_));
    const Vector3 points = feet_[side].rotation * arm;
    const double off = std::atan2(-points.x(), points.y()), wanted = side == 0 ? kOutward : -kOutward;
    return Quaternion{Eigen::AngleAxisd(wanted - off, Vector3::UnitZ())} * feet_[side].rotation;
  }

  void stand_on_feet() {
    pose(mean_);
    double lift = std::numeric_limits<double>::infinity();
    for (int side = 0; side < 2; ++side) {
      const Leg& leg = legs_[side];
      lift = std::min(lift, feet_[side].ankle + kHipsReach * leg_length(leg, posed_) - posed_.heads[leg.thigh].z());
    }
    mean_.height += lift;
    pose(mean_);
    for (int side = 0; side < 2; ++side) {
      const Leg& leg = legs_[side];
      const Vector3 hip = posed_.heads[leg.thigh];
      turn_to(leg, pointing(side), posed_);
      reach(kinematics_.skeleton(), leg, posed_, {hip.x(), hip.y(), feet_[side].ankle}, mean_.rotations.data());
      if (leg.toe >= 0) store_quaternion(feet_[side].toe, &mean_.rotations[std::size_t{4} * leg.toe]);
    }
  }

  const Kinematics& kinematics_;
  const Legs& legs_;
  std::vector<int> measured_;
  PosedBones posed_;
  BodyPose mean_;
  std::array<FlatFoot, 2> feet_;
  double floor_ = 0, count_ = 0;  // m, summed; poses
};

// 1/f noise over a time that it fills, so that it goes on where it began: a random phase for each harmonic.
class Sway {
 public:
  Sway(Random& random, double strength) {
    double power = 0;
    for (int k = 1; k <= kHarmonics; ++k) power += 0.5 / (k * k);
    for (double& phase : phases_) phase = 2 * kPi * random.uniform();
    strength_ = strength / std::sqrt(power);
  }

  double at(double share) const {
    double sum = 0;
    for (int k = 1; k <= kHarmonics; ++k) sum += std::sin(2 * kPi * k * share + phases_[k - 1]) / k;
    return strength_ * sum;
  }

 private:
  static constexpr int kHarmonics = 12;

  std::array<double, kHarmonics> phases_{};
  double strength_;
};

// What moves a body that stands; its axes are the character frame's.
class Swayer {
 public:
  Swayer(const Kinematics& kinematics, const Legs& legs, const BodyPose& pose, double seconds)
      : kinematics_(kinematics),
        legs_(legs),
        trunk_(kinematics.skeleton()),
        pose_(pose),
        breaths_(std::max(1.0, std::round(seconds / kBreath))),
        scale_(standard_scale(kinematics.skeleton())),
        posed_(kinematics.bones()) {
    kinematics.world({0, 0, pose.height}, pose.rotations.data(), posed_.heads.data(), posed_.rotations.data());
    for (int side = 0; side < legs.count(); ++side) ankles_[side] = ankle_of(legs[side], posed_);
  }

  // Adds the frame of a share of the time.
  void append_to(Clip& clip, double share) {
    const Vector2 shift = Vector2{across_.at(share), along_.at(share)} / scale_;
    BodyPose pose = pose_;
    move_upper_body(share, pose);
    lower_hips(shift, pose);
    append(kinematics_, clip, {shift, 0}, pose);
  }

 private:
  void move_upper_body(double share, BodyPose& pose) {
    const Skeleton& skeleton = kinematics_.skeleton();
    const double deeper = 0.5 - 0.5 * std::cos(2 * kPi * (breaths_ * share + uneven_.at(share)));
    turn_spine(skeleton, trunk_, Vector3::UnitY(), lean_.at(share), pose.rotations.data());
    if (trunk_.chest < 0) return;
    turn_bone(skeleton, trunk_.chest, Vector3::UnitX(), kDepth * deeper, pose.rotations.data());
    if (trunk_.head < 0) return;
    turn_bone(skeleton, trunk_.head, Vector3::UnitX(), nod_.at(share) - kDepth * deeper, pose.rotations.data());
    turn_bone(skeleton, trunk_.head, Vector3::UnitZ(), look_.at(share), pose.rotations.data());
  }

  // The hips go aside; the feet stay, and the hips come down as far as the legs are too short.
  void lower_hips(const Vector2& shift, BodyPose& pose) {
    if (legs_.count() == 0) return;
    const auto posed = [&] {
      kinematics_.world({shift.x(), shift.y(), pose.height}, pose.rotations.data(), posed_.heads.data(),
                        posed_.rotations.data());
    };
    posed();
    double sink = 0;
    for (int side = 0; side < legs_.count(); ++side) {
      const Leg& leg = legs_[side];
      sink = std::max(sink, too_high(longest(leg, posed_), posed_.heads[leg.thigh], ankles_[side]));
    }
    pose.height -= sink;
    posed();
    for (int side = 0; side < legs_.count(); ++side)
      reach(kinematics_.skeleton(), legs_[side], posed_, ankles_[side], pose.rotations.data());
  }

  const Kinematics& kinematics_;
  const Legs& legs_;
  Trunk trunk_;
  const BodyPose& pose_;
  double breaths_, scale_;
  PosedBones posed_;
  std::array<Vector3, kMostLegs> ankles_;
  Random random_{1};
  Sway across_{random_, kAcross}, along_{random_, kAlong}, lean_{random_, kLean}, look_{random_, kLook},
      nod_{random_, kNod}, uneven_{random_, kUneven};
};

BodyPose stance(const Kinematics& kinematics, const Legs& legs, const FragmentPool& pool) {
  Stance stance(kinematics, legs);
  for (const int i : slowest_of(pool)) {
    const Fragment& fragment = pool.fragments[i];
    const Clip& clip = pool.clips[fragment.clip];
    for (int f = fragment.begin; f < fragment.end; ++f) stance.add(body_pose(kinematics, clip, f));
  }
  return stance.result();
}

Clip named_clip(double rate) {
  Clip clip;
  clip.name = "standing";
  clip.rate = rate;
  return clip;
}

}  // namespace

Clip standing(const Kinematics& kinematics, const Legs& legs, const FragmentPool& pool, int frames, double rate) {
  const BodyPose pose = stance(kinematics, legs, pool);
  Clip clip = named_clip(rate);
  while (clip.frames < frames) append(kinematics, clip, {}, pose);
  return clip;
}

Clip living_stand(const Kinematics& kinematics, const Legs& legs, const FragmentPool& pool, int cycle, int frames,
                  double rate) {
  const BodyPose pose = stance(kinematics, legs, pool);
  Swayer swayer(kinematics, legs, pose, cycle / rate);
  Clip clip = named_clip(rate);
  while (clip.frames < frames) swayer.append_to(clip, static_cast<double>(clip.frames) / cycle);
  return clip;
}

}  // namespace fragmotion

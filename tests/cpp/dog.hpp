// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <utility>

#include "add_bone.hpp"
#include "walker.hpp"

namespace fragmotion {

constexpr double kDogTrunk = 0.9;  // m from the hips to the shoulders

/// A body on four legs, each like one of humanoid(); it faces -y, its left is at +x. Its names tell sides alone.
inline Skeleton dog() {
  Skeleton s;
  const auto add = [&](const std::string& name, int parent, const Vector3& offset, const Vector3& tip) {
    add_bone(s, name, parent, offset, tip);
  };
  add("a", -1, {0, 0, 0.96}, {0, -kDogTrunk, 0});
  add("b", 0, {0, -kDogTrunk, 0}, {0, -0.1, 0});
  add("c", 1, {0, -0.2, 0.1}, {0, -0.2, 0});
  for (const bool fore : {false, true}) {
    for (const double side : {1.0, -1.0}) {
      const std::string name = fore ? "f" : "h", end = side > 0 ? ".L" : ".R";
      const int leg = s.size();
      add(name + "1" + end, fore ? 1 : 0, {0.1 * side, 0, -0.02}, {0, 0, -0.44});
      add(name + "2" + end, leg, {0, 0, -0.44}, {0, 0, -0.42});
      add(name + "3" + end, leg + 1, {0, 0, -0.42}, {0, -0.18, -0.08});
    }
  }
  return make_skeleton(std::move(s));
}

/// When a leg of a dog that goes straight ahead is as a hind left one was, in cycles: a trot, or a walk of four beats.
inline double dog_phase(int leg, bool trots) {
  constexpr double kWalk[] = {0, 0.5, 0.25, 0.75}, kTrot[] = {0, 0.5, 0.5, 0};
  return trots ? kTrot[leg] : kWalk[leg];
}

/// A take of a dog that goes straight ahead as `gait` says, on planted feet.
inline Clip dog_clip(const Gait& gait, bool trots, const std::string& name) {
  const Skeleton skeleton = dog();
  Clip clip;
  clip.name = name;
  clip.rate = gait.rate;
  clip.frames = static_cast<int>(std::lround(gait.seconds * gait.rate)) + 1;
  const double height = gait.steps() ? 0.9 : 0.94;
  for (int f = 0; f < clip.frames; ++f) {
    const double t = f / gait.rate;
    std::vector<double> pose;
    for (int b = 0; b < skeleton.size(); ++b) pose.insert(pose.end(), {1, 0, 0, 0});
    store_quaternion(CharacterFrame{{0, 0}, kPi}.rotation(), pose.data());
    for (int leg = 0; leg < 4; ++leg) {
      const double side = leg % 2 == 0 ? 1 : -1, ahead = gait.steps() ? dog_phase(leg & ~1, trots) * gait.cycle : 0;
      CharacterFrame frame = gait.at(t);
      Vector3 ankle = foot_target(gait, side, t + ahead);
      ankle.head<2>() += frame.position - gait.at(t + ahead).position;
      if (leg >= 2) frame.position.y() += kDogTrunk, ankle.y() += kDogTrunk;
      const int thigh = skeleton.find(std::string(leg < 2 ? "h1" : "f1") + (leg % 2 == 0 ? ".L" : ".R"));
      bend_leg(frame, height, side, ankle, &pose[std::size_t{4} * thigh]);
    }
    const Vector2 place = gait.at(t).position;
    clip.root_positions.insert(clip.root_positions.end(), {place.x(), place.y(), height});
    clip.rotations.insert(clip.rotations.end(), pose.begin(), pose.end());
  }
  return make_clip(skeleton, std::move(clip));
}

/// A stand, a walk and a trot.
inline std::vector<Clip> dog_takes() {
  Gait stand, trot;
  stand.y = 0;
  trot.y = 3;
  trot.cycle = 0.6;
  return {dog_clip(stand, false, "stand"), dog_clip({}, false, "walk"), dog_clip(trot, true, "trot")};
}

}  // namespace fragmotion

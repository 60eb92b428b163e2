// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "dog.hpp"
#include "motion/take.hpp"
#include "skeleton/roles.hpp"

namespace fragmotion {

/// The take of a dog as files of motion capture may hold it: the bones have a man's names, and lie one behind another
/// along +x at rest, so that neither tells what they are.
inline Take lying_dog_take(const Clip& clip) {
  constexpr const char* kNames[] = {"Hips",        "Spine",      "Head",     "LeftUpLeg",    "LeftLeg",
                                    "LeftFoot",    "RightUpLeg", "RightLeg", "RightFoot",    "LeftArm",
                                    "LeftForeArm", "LeftHand",   "RightArm", "RightForeArm", "RightHand"};
  Take take = take_from_clip(dog(), clip);
  std::vector<double> places, turns;
  world_transforms(take, places, turns);
  Skeleton lying = take.skeleton;
  const std::vector<Vector3> tips = lying.tips, offsets = lying.offsets;
  std::vector<Quaternion> rolls;
  for (const Vector3& tip : tips) rolls.push_back(Quaternion::FromTwoVectors(Vector3::UnitX(), tip));
  for (int b = 0; b < lying.size(); ++b) {
    const int parent = lying.parents[b];
    lying.names[b] = kNames[b];
    lying.tips[b] = rolls[b].conjugate() * tips[b];
    if (parent >= 0) lying.offsets[b] = rolls[parent].conjugate() * offsets[b];
    for (int f = 0; f < take.frames; ++f) {
      const std::size_t first = std::size_t{4} * f * lying.size();
      const auto world = [&](int bone) -> Quaternion {
        return load_quaternion(&turns[first + std::size_t{4} * bone]) * rolls[bone];
      };
      store_quaternion(parent < 0 ? world(b) : world(parent).conjugate() * world(b),
                       &take.rotations[first + std::size_t{4} * b]);
      if (parent >= 0)
        store_vector(lying.offsets[b], &take.translations[std::size_t{3} * (std::size_t(f) * lying.size() + b)]);
    }
  }
  lying.roles = {};
  take.skeleton = make_skeleton(lying);
  return take;
}

/// The same where it is shown at rest.
inline Take resting_dog_take() {
  Take take = lying_dog_take(dog_clip({}, false, "rest"));
  for (std::size_t i = 0; i < take.rotations.size(); i += 4)
    store_quaternion(Quaternion::Identity(), &take.rotations[i]);
  return take;
}

}  // namespace fragmotion

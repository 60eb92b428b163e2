// SPDX-License-Identifier: MIT
#pragma once

#include "fragments/look.hpp"
#include "motion/trunk.hpp"
#include "small_character.hpp"

namespace fragmotion {

constexpr double kLooksAside = 1.0, kChestAside = 0.3, kNods = 0.7;  // rad

/// A take whose head looks about in 2 s, and whose chest turns with it.
inline Clip looking_clip(const Gait& gait, const std::string& name) {
  const Skeleton skeleton = humanoid();
  const Trunk trunk(skeleton);
  Clip clip = gait_clip(gait, name);
  for (int f = 0; f < clip.frames; ++f) {
    const double side = std::sin(kPi * f / clip.rate);
    double* rotations = &clip.rotations[std::size_t{4} * skeleton.size() * f];
    turn_bone(skeleton, skeleton.roles.head, Vector3::UnitX(), kNods * std::cos(0.7 * kPi * f / clip.rate), rotations);
    turn_bone(skeleton, trunk.chest, Vector3::UnitZ(), kChestAside * side, rotations);
    turn_bone(skeleton, skeleton.roles.head, Vector3::UnitZ(), (kLooksAside - kChestAside) * side, rotations);
  }
  return clip;
}

/// Stands, walks and turns, and looks about.
inline std::shared_ptr<const Character> looking_character() {
  static const auto character = [] {
    Gait stand, walk, turn;
    stand.y = 0;
    turn.turn = 0.8;
    stand.seconds = walk.seconds = turn.seconds = 4;
    BuildOptions options;
    options.classes = 8;
    options.synthesize = false;
    options.policies = {"greedy"};
    return std::make_shared<const Character>(
        build(humanoid(), {looking_clip(stand, "stand"), looking_clip(walk, "walk"), looking_clip(turn, "turn")},
              {simulate_trace("explorer", 20, 1, ControlSpace())}, options));
  }();
  return character;
}

}  // namespace fragmotion

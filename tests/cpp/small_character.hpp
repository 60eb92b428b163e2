// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "fragmotion/character.hpp"
#include "walker.hpp"

namespace fragmotion {

/// A character with all gaits, built once from made takes.
inline std::shared_ptr<const Character> gait_character() {
  static const auto character = [] {
    BuildOptions options;
    options.classes = 40;
    options.policies = {"anticipate", "svm"};
    const ControlSpace space;
    return std::make_shared<const Character>(
        build(humanoid(), gait_takes(),
              {simulate_trace("explorer", 30, 1, space), simulate_trace("walker", 30, 2, space)}, options));
  }();
  return character;
}

/// A character of a few kilobytes: four bones, two short takes, two classes.
inline Character tiny_character() {
  Skeleton skeleton;
  skeleton.names = {"hips", "spine", "leg.L", "leg.R"};
  skeleton.parents = {-1, 0, 0, 0};
  skeleton.rest_rotations.assign(4, Quaternion::Identity());
  skeleton.offsets = {{0, 0, 1}, {0, 0, 0.1}, {0.1, 0, 0}, {-0.1, 0, 0}};
  skeleton.tips = {{0, 0, 0.1}, {0, 0, 0.6}, {0, 0, -0.9}, {0, 0, -0.9}};
  skeleton = make_skeleton(skeleton);
  std::vector<Clip> clips;
  for (const double speed : {0.0, 1.5}) {
    Clip clip{"take", 20, 11, {}, {}, {}};
    for (int f = 0; f < clip.frames; ++f) {
      clip.root_positions.insert(clip.root_positions.end(), {0, -speed * f / 20, 1});
      for (int b = 0; b < 4; ++b) {
        const double angle = b < 2 ? 0 : (b == 2 ? 1 : -1) * 0.3 * speed * std::sin(0.6 * f);
        clip.rotations.insert(clip.rotations.end(), {std::cos(angle / 2), std::sin(angle / 2), 0, 0});
      }
    }
    clips.push_back(make_clip(skeleton, clip));
  }
  BuildOptions options;
  options.classes = 2;
  options.mirror = options.synthesize = false;
  options.policies = {"greedy"};
  return build(skeleton, clips, {{{}, {}}}, options);
}

}  // namespace fragmotion

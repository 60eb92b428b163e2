// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "build/build.hpp"
#include "character/character.hpp"
#include "control/simulated_players.hpp"
#include "skeleton/roles.hpp"
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

/// Hips, a spine and two limbs that nothing tells to be legs.
inline Skeleton tiny_skeleton() {
  Skeleton skeleton;
  skeleton.names = {"hips", "spine", "limb.L", "limb.R"};
  skeleton.parents = {-1, 0, 0, 0};
  skeleton.rest_rotations.assign(4, Quaternion::Identity());
  skeleton.offsets = {{0, 0, 1}, {0, 0, 0.1}, {0.1, 0, 0}, {-0.1, 0, 0}};
  skeleton.tips = {{0, 0, 0.1}, {0, 0, 0.6}, {0, 0, -0.9}, {0, 0, -0.9}};
  return make_skeleton(skeleton);
}

/// Hips, spine, head, and legs of one bone with feet: no knees. `root`: below a bone on the ground.
inline Skeleton kneeless_skeleton(bool root) {
  Skeleton s;
  s.names = {"hips", "spine", "head", "leg.L", "foot.L", "leg.R", "foot.R"};
  s.parents = {-1, 0, 1, 0, 3, 0, 5};
  s.offsets = {{0, 0, 0.9}, {0, 0, 0.2}, {0, 0, 0.4}, {0.1, 0, 0}, {0, 0, -0.8}, {-0.1, 0, 0}, {0, 0, -0.8}};
  s.tips = {{0, 0, 0.2}, {0, 0, 0.4}, {0, 0, 0.2}, {0, 0, -0.8}, {0, -0.2, -0.1}, {0, 0, -0.8}, {0, -0.2, -0.1}};
  if (root) {
    s.names.insert(s.names.begin(), "root");
    for (int& parent : s.parents) ++parent;
    s.parents.insert(s.parents.begin(), -1);
    s.offsets.insert(s.offsets.begin(), Vector3::Zero());
    s.tips.insert(s.tips.begin(), {0, 0, 0.5});
  }
  s.rest_rotations.assign(s.names.size(), Quaternion::Identity());
  return make_skeleton(s);
}

/// Three seconds of a kneeless_skeleton() that goes forward on stiff legs at `speed` m/s.
inline Clip kneeless_clip(const Skeleton& skeleton, double speed) {
  Clip clip{"stiff", 30, 91, {}, {}, {}};
  for (int f = 0; f < clip.frames; ++f) {
    const double angle = 0.4 * speed * std::sin(2 * kPi * f / 30);
    clip.root_positions.insert(clip.root_positions.end(), {0, -speed * f / 30, 0.9 - 0.05 * speed * angle * angle});
    for (const std::string& name : skeleton.names) {
      const double swing = name == "leg.L" ? angle : name == "leg.R" ? -angle : 0;
      clip.rotations.insert(clip.rotations.end(), {std::cos(swing / 2), std::sin(swing / 2), 0, 0});
    }
  }
  return make_clip(skeleton, clip);
}

/// A small character with legs, feet and contacts, which stands, walks and hops, also mirrored.
inline Character legged_character() {
  Gait stand, walk, hop;
  stand.y = hop.y = 0;
  hop.jump = 0.3;
  stand.seconds = hop.seconds = 1;
  walk.seconds = 2;
  BuildOptions options;
  options.classes = 6;
  options.synthesize = false;
  options.policies = {"anticipate", "greedy"};
  return build(humanoid(), {gait_clip(stand, "stand"), gait_clip(walk, "walk"), gait_clip(hop, "hop")},
               {simulate_trace("explorer", 20, 1, ControlSpace())}, options);
}

/// Half a second: one fragment of a tiny_skeleton() that goes forward at `speed` m/s and hops `hop` m high.
inline Clip tiny_clip(double speed, double hop = 0) {
  Clip clip{"take", 20, 11, {}, {}, {}};
  for (int f = 0; f < clip.frames; ++f) {
    clip.root_positions.insert(clip.root_positions.end(), {0, -speed * f / 20, 1 + hop * 0.04 * f * (10 - f)});
    for (int b = 0; b < 4; ++b) {
      const double angle = b < 2 ? 0 : (b == 2 ? 1 : -1) * 0.3 * speed * std::sin(0.5 * f);  // no cycle
      clip.rotations.insert(clip.rotations.end(), {std::cos(angle / 2), std::sin(angle / 2), 0, 0});
    }
  }
  return make_clip(tiny_skeleton(), clip);
}

/// A character of tiny_clip()s, each a class of its own, and perhaps their mirror images.
inline Character tiny_character(const std::vector<Clip>& clips = {tiny_clip(0), tiny_clip(1.5)}, bool mirror = false) {
  BuildOptions options;
  options.classes = static_cast<int>(clips.size());
  options.mirror = mirror;
  options.synthesize = false;
  options.policies = {"greedy"};
  return build(tiny_skeleton(), clips, {{{}, {}}}, options);
}

}  // namespace fragmotion

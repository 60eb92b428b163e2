// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "build/styles.hpp"
#include "made_moves.hpp"

namespace fragmotion {

/// gait_takes() with a bent back, at three quarters of their speed.
inline std::vector<Clip> tired_takes() {
  std::vector<Clip> takes = gait_takes();
  const int spine = humanoid().find("spine");
  for (Clip& clip : takes) {
    clip.rate *= 0.75;
    for (int f = 0; f < clip.frames; ++f) {
      store_quaternion(Quaternion{Eigen::AngleAxisd(0.5, Vector3::UnitX())},
                       &clip.rotations[std::size_t{4} * (f * humanoid().size() + spine)]);
    }
    clip = make_clip(humanoid(), clip);
  }
  return takes;
}

inline BuildOptions style_options() {
  BuildOptions options;
  options.classes = 40;
  options.policies = {"anticipate", "svm"};
  return options;
}

inline std::vector<Trace> style_traces() {
  return {simulate_trace("explorer", 30, 1, ControlSpace()), simulate_trace("walker", 30, 2, ControlSpace())};
}

/// A character of tired_takes() alone.
inline std::shared_ptr<const Character> tired_character() {
  static const auto character =
      std::make_shared<const Character>(build(humanoid(), tired_takes(), style_traces(), style_options()));
  return character;
}

/// moving_character() that can be tired, too.
inline std::shared_ptr<const Character> styled_character() {
  static const auto character =
      std::make_shared<const Character>(with_styles({{"normal", moving_character()}, {"tired", tired_character()}}));
  return character;
}

}  // namespace fragmotion

// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "build/build.hpp"
#include "fragments/distance.hpp"

namespace fragmotion {

/// What a build learns from: a character that has its fragments and no classes yet, and what learning needs besides.
struct Material {
  std::shared_ptr<Character> character;
  Trajectories trajectories;
  std::vector<std::vector<int>> traces;  ///< Control indices.
};

/// The first half of build(): fragments, synthesis, control space.
Material prepare(const Skeleton& skeleton, const std::vector<Clip>& clips, const std::vector<Trace>& traces,
                 const BuildOptions& options, const Progress& progress);

/// The second half: classes, Eq. 2 and policies, in place of those that the character has.
void learn(const Material& material, const BuildOptions& options, const Progress& progress);

/// The character without its moves.
Character without_moves(Character character);

}  // namespace fragmotion

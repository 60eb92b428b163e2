// SPDX-License-Identifier: MIT
#pragma once

#include "build/build.hpp"

namespace fragmotion {

/// The takes of a style.
struct StyleTakes {
  std::string name;
  std::vector<Clip> clips;
};

/// A character with a style of each set of takes, which drives in the first: each with classes and policies as build()
/// makes of its takes alone. Throws as build(), naming the style, and as with_styles().
Character build_styles(const Skeleton& skeleton, const std::vector<StyleTakes>& styles,
                       const std::vector<Trace>& traces, const BuildOptions& options = {},
                       const Progress& progress = {});

/// A character in a style.
struct StyledCharacter {
  std::string name;
  std::shared_ptr<const Character> character;
};

/// One character in all these styles, which drives in the first and has the moves of the first. Throws
/// std::invalid_argument on none, more than kMostStyles, two of one name, one without, one that has styles itself, and
/// on one that is of another skeleton or has other policies than the first.
Character with_styles(const std::vector<StyledCharacter>& styles);

}  // namespace fragmotion

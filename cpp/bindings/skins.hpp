// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "arrays.hpp"
#include "skeleton/skin.hpp"

namespace fragmotion::bindings {

/// A skin, and the bones that it follows.
class BoundSkin {
 public:
  explicit BoundSkin(const Skeleton& skeleton) : bones_(skeleton.names) {}

  /// See the stub.
  void add(const Doubles& world, const Doubles& points, const std::vector<std::string>& groups, const Doubles& weights);

  /// Throws std::invalid_argument where the skeleton has other bones.
  const Skin& of(const Skeleton& skeleton) const;

 private:
  std::vector<std::string> bones_;
  Skin skin_;
};

/// The skin, or none where there is none.
const Skin* skin_of(const BoundSkin* bound, const Skeleton& skeleton);

}  // namespace fragmotion::bindings

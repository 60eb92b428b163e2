// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "policy.hpp"

namespace fragmotion::godot {

/// Many of one policy who make way for each other: what the node FragmotionCrowd is made of. Calls that fail return
/// false and say in Godot's debugger what was wrong.
class Players {
 public:
  static constexpr const char *kName = "FragmotionPlayers", *kParent = "RefCounted";
  static void add();

  /// So many, each with a seed of its own from this on.
  bool make(Object policy, std::int64_t count, std::int64_t seed);
  /// Before each step. `radius`: of each, m; `others`: place and velocity of each who does not make way.
  bool make_way(double radius, double seconds, VectorArray others);

  /// Shared with its players, who need it as long as they play; null before make().
  const std::shared_ptr<game::Crowd>& crowd() const { return crowd_; }

 private:
  std::shared_ptr<game::Crowd> crowd_;
};

}  // namespace fragmotion::godot

// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "base/types.hpp"

namespace fragmotion {

/// The ground about a place, as a plane.
struct GroundPlane {
  double height = 0;                ///< m, at the place.
  Vector2 slope = Vector2::Zero();  ///< How much it rises along x and y.
};

/// What a foot asked the ground lately, and how often it may ask still. Where it may not, the nearest place that it
/// knows tells.
class GroundMemory {
 public:
  static constexpr std::size_t kPlaces = 32;

  /// `most`: how often the ground may be asked from now on.
  void advance(double seconds, int most);
  int left() const { return left_; }
  /// Whether the ground is known within so many metres of a place, or may not be asked for: then it is `plane`.
  bool knows(const Vector2& place, double within, std::optional<GroundPlane>& plane) const;
  /// What was asked for, which may be none.
  void keep(const Vector2& place, const std::optional<GroundPlane>& plane);

 private:
  friend struct PlayerState;

  struct Asked {
    Vector2 place = Vector2::Zero();
    GroundPlane plane;
    bool exists = false;
    double age = 0;  // s
  };

  std::array<Asked, kPlaces> asked_;
  int count_ = 0, next_ = 0, left_ = 0;
};

}  // namespace fragmotion

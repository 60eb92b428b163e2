// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "feet/footing.hpp"

namespace fragmotion {

/// What a foot knows of the ground: the planes at the places that it asked for last. It asks for a place that it does
/// not know as often as it may, and beyond that the nearest that it knows tells.
class KnownGround {
 public:
  static constexpr double kInTheWay = 1;  ///< edges() of a sole that reaches into a step.

  /// How exactly a place is known: it was asked for; or it is between two, one behind the other along a way, that are
  /// on one plane, or next to one, and these are at most `beside` to the side, m of a character of 1.8 m.
  struct Along {
    Vector2 way = Vector2::UnitY();
    double beside = 0;
  };

  void forget() { count_ = next_ = 0; }
  /// Asks for a place.
  std::optional<Footing> ask(const Vector2& place, GroundProbe& probe);
  std::optional<Footing> at(const Vector2& place, const Along& along, GroundProbe& probe);
  /// How far a sole is better moved than set where it is, m of a character of 1.8 m: 0 unless ground of another height
  /// than that under its ball is under its ends or just beyond them.
  double edges(const Sole& sole, GroundProbe& probe);
  /// How far the ground reaches over a plane into a sole that is so much lower than captured, m; 0 where it does not.
  double over(const Sole& sole, double lower, const Footing& plane, const Along& along, GroundProbe& probe);

 private:
  friend struct PlayerState;

  static constexpr int kMost = 32;

  struct Known {
    Footing plane;
    bool exists = false;
  };

  static bool agree(const Known& a, const Known& b, double metre);

  std::array<Known, kMost> known_;
  int count_ = 0, next_ = 0;  // and where the next one is kept
};

}  // namespace fragmotion

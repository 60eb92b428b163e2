// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "feet/feet_ahead.hpp"
#include "feet/ground.hpp"

namespace fragmotion {

// Lengths are those of a character of 1.8 m.
/// m by which ground differs that is not level: as high is an edge, and so far a foot keeps from one.
constexpr double kUneven = 0.03;
/// m within which it is the same place.
constexpr double kThere = 0.01;
/// m between places that may be on one plane.
constexpr double kApart = 0.13;
/// m that a sole is moved at a time to be off an edge.
constexpr double kTried = 0.02;
/// m that a body steps up, sinks or lifts a foot over ground at most.
constexpr double kHighestStep = 0.7;

/// The plane that a sole stands on.
struct Footing {
  Vector2 place = Vector2::Zero();  ///< Where it is at `height`, m.
  double height = 0;
  Vector2 slope = Vector2::Zero();  ///< How much it rises along x and y.

  double at(const Vector2& there) const { return height + dot(slope, there - place); }
};

/// The plane that touches the ground under a sole's points and is nowhere below it, as steep as the ground is on
/// average. None where there is no ground.
std::optional<Footing> plane_under(const Sole& sole, const std::array<std::optional<Footing>, 3>& points);

/// What feet ask the ground, from one height downward, so many times at most. `metre`: what is a metre of a character
/// of 1.8 m, by which feet of all sizes tell edges and places apart.
class GroundProbe {
 public:
  GroundProbe(const Ground& ground, double above, int most, double metre = 1)
      : ground_(&ground), above_(above), metre_(metre), left_(most) {}

  double metre() const { return metre_; }
  /// Whether it may, if so many questions are spared for others.
  bool may_ask() const { return left_ > spared_; }
  void spare(int spared) { spared_ = spared; }
  void look_from(double above) { above_ = above; }
  /// What the ground answers, if it is ground.
  std::optional<GroundPoint> ask(const Vector2& place);
  /// The plane of the ground at a place, at most as steep as a foot is turned.
  std::optional<Footing> at(const Vector2& place);

 private:
  const Ground* ground_;
  double above_, metre_;
  int left_, spared_ = 0;
};

}  // namespace fragmotion

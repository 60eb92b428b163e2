// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "base/types.hpp"

namespace fragmotion {

/// Velocities v with (v - point) . normal >= 0, m/s in the world.
struct HalfPlane {
  Vector2 point, normal;
};

/// The velocities by which one keeps clear of those around it.
struct Clearance {
  static constexpr int kMost = 10;       ///< Those that are nearest count,
  static constexpr int kMostOthers = 4;  ///< and so many things beside.
  std::array<HalfPlane, kMost + kMostOthers> planes;
  int count = 0;
  int walkers = 0;  ///< That many planes, the first ones, are of others who make way; the rest of what never does.

  /// Keeps clear of something else, too; beyond the most of them of nothing more.
  void add(const HalfPlane& plane);

  /// The one next to what is wanted, at most so fast. Where there is none, that which is off by the least for the
  /// others, and clear of what stands there; where that leaves none, that which is off by the least for all.
  Vector2 nearest(const Vector2& wanted, double most) const;
};

/// One of many on the ground, as if it were round.
struct Walker {
  Vector2 place, velocity;         ///< m, m/s
  double radius = 0;               ///< m
  bool yields = true;              ///< Makes way; for who does not, others go all of the way.
  bool stays = false;              ///< Wants to go nowhere: makes way for what others wish, too.
  Vector2 wish = Vector2::Zero();  ///< m/s that it would have beside its velocity.
};

/// How one gets past others: by the right-hand rule of deadlocked robots and of people, who is held up turns to his
/// right, the more so the more he is, up to a right angle; and those who stay see what he wants, as who stands about
/// steps aside for who asks. Who gets no further all the same, as where all want to be in one place, waits. His
/// patience comes back while he gets on, and while he stands and nobody presses.
class WayRound {
 public:
  static constexpr double kPatience = 10;  ///< s of being held up wholly after which one waits.

  /// The velocity for the next `seconds`.
  Vector2 choose(const Clearance& clearance, const Vector2& wanted, double most, double seconds);
  /// Lets others see what was wanted last.
  void show(Walker& walker) const;

 private:
  friend struct PlayerState;

  Vector2 wanted_ = Vector2::Zero();
  double held_up_ = 0;  // s, 0 .. kPatience
};

/// The velocities by which one keeps clear of another for MakeWay::kAhead; who touch part within so many `seconds`.
HalfPlane clear_of(const Walker& one, const Walker& other, double seconds);

/// Who makes way for whom: "Reciprocal n-body collision avoidance" (van den Berg, Guy, Lin, Manocha, 2011). The same
/// walkers have the same bits.
class MakeWay {
 public:
  /// Looks at all of them. Allocates only where they are more than ever before.
  void look(const std::vector<Walker>& walkers);
  /// Of one that was looked at, who sees those as far away as both come within kAhead. `seconds`: a step, within which
  /// those that touch part.
  Clearance clearance(std::size_t walker, double seconds) const;

  static constexpr double kAhead = 2;  ///< s in which they are not to touch.

 private:
  struct Seen {
    double square;
    std::size_t walker;
  };

  std::int64_t cell(const Vector2& place, int column, int row) const;
  template <typename Each>
  void each_near(const Vector2& place, const Each& each) const;

  std::vector<Walker> walkers_;
  std::vector<std::pair<std::int64_t, std::size_t>> cells_;  // each one's, in order
  double reach_ = 1;                                         // m, that a cell is wide
};

}  // namespace fragmotion

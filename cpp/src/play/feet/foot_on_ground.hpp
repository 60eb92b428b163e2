// SPDX-License-Identifier: MIT
#pragma once

#include "base/approach.hpp"
#include "feet/known_ground.hpp"

namespace fragmotion {

/// How one foot is moved from level ground onto the ground: it stands on the plane of its footing, and goes from one to
/// the next over what is in its way. A foot that rests asks nothing; one on its way asks for what is under its landing,
/// and with what is left of a step's questions for edges beside that and for what is before it. Where it is to land, or
/// comes to stand, elsewhere than was foreseen, it gets there smoothly, too.
class FootOnGround {
 public:
  static constexpr int kAsksAtLeast = 3;  ///< times, for what is under its sole

  /// Goes on by `seconds`. `lower`: how much lower than captured it is shown, m. Asks the ground until only `spared`
  /// questions are left. Returns whether there is ground where the foot stands, or where it is to.
  bool advance(const FootAhead& foot, double lower, double seconds, GroundProbe& probe, int spared);

  /// Of what would be level ground under it, with what it clears; m.
  double height() const { return plane_.height + error_.value + lift_; }
  const Vector2& slope() const { return plane_.slope; }
  /// How far it is moved along itself: where it would stand on an edge, it stands beside it. m.
  Vector2 shift() const { return {shift_[0].value, shift_[1].value}; }
  /// How much its leg must reach it, and its sole is on its footing rather than as high as it was captured, 0 .. 1: it
  /// stands, or did just now, or is about to.
  double weight() const { return weight_; }

  /// What it knows of the ground beside its footings is of another place.
  void forget_ground() { known_.forget(); }

  /// On which it stands, or stood last, and on which it is to stand.
  const Footing& last() const { return last_; }
  const Footing& next() const { return next_; }
  /// Since it stood, s.
  double swing_time() const { return swing_time_; }

 private:
  friend struct PlayerState;

  void stand(const FootAhead& foot, GroundProbe& probe, int spared);
  void swing(const FootAhead& foot, GroundProbe& probe, int spared);
  Vector2 beside_edges(const FootAhead& foot, GroundProbe& probe);
  std::optional<Footing> ask_under(const Sole& sole, GroundProbe& probe);
  void advance_shift(const FootAhead& foot, double seconds);
  void clear(const FootAhead& foot, double lower, double seconds, GroundProbe& probe);
  void bear(const FootAhead& foot, double seconds);
  double part_of_way(const Vector2& place, double later) const;
  Footing on_way(const Vector2& place, double later) const;
  double lift(const Vector2& place, double later) const;
  double height_on_way(const Vector2& place, double later) const;

  bool fresh_ = true, stood_ = false;
  bool found_ = true;  // ground under where it stands, or is to
  Footing last_, next_;
  KnownGround known_;
  Footing plane_;                     // under it now, from the one to the other
  Approach error_;                    // of the height that is shown
  Vector2 beside_ = Vector2::Zero();  // how far it is to be moved
  std::array<Approach, 2> shift_;
  Approach clearance_;               // how high it steps over what is in its way, m
  double swing_time_ = 0, due_ = 0;  // s since it stood, and until it stands
  double metre_ = 1;                 // GroundProbe::metre()
  double lift_ = 0, weight_ = 1;     // m; 0 .. 1
};

}  // namespace fragmotion

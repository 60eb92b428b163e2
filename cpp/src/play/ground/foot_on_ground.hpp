// SPDX-License-Identifier: MIT
#pragma once

#include "ground/approach.hpp"
#include "ground/footing.hpp"

namespace fragmotion {

/// How one foot is moved from level ground onto the ground: it stands on the plane of its footing, and goes from one to
/// the next over what is in its way. Where it comes to stand on another than was foreseen, it gets there smoothly, too.
class FootOnGround {
 public:
  /// Goes on by `seconds`. `lower`: how much lower than captured it is shown, m. Returns whether there is ground where
  /// the foot stands, or where it is to.
  bool advance(const FootAhead& foot, double lower, double seconds, const GroundProbe& probe);

  /// Of what would be level ground under it, with what it clears; m.
  double height() const { return plane_.height + error_.value + lift_; }
  Vector2 slope() const { return plane_.slope + Vector2{turn_[0].value, turn_[1].value}; }
  /// How far it is moved along itself: where it would stand on an edge, it stands beside it. m.
  Vector2 shift() const { return {shift_[0].value, shift_[1].value}; }
  /// How much its leg must reach it, 0 .. 1: it stands, or did just now, or is about to.
  double contact_weight() const { return contact_weight_; }
  /// How much its sole is on its footing rather than as high as it was captured, likewise.
  double sole_weight() const { return sole_weight_; }

  /// On which it stands, or stood last, and on which it is to stand.
  const Footing& last() const { return last_; }
  const Footing& next() const { return next_; }
  /// Since it stood, s.
  double swing_time() const { return swing_time_; }
  /// Whether it is on its footing as foreseen.
  bool arrived() const { return error_.rests() && turn_[0].rests() && turn_[1].rests() && lift_ == 0; }

 private:
  friend struct PlayerState;

  bool stand(const FootAhead& foot, const GroundProbe& probe);
  bool swing(const FootAhead& foot, const GroundProbe& probe);
  Vector2 beside_edges(const FootAhead& foot, const GroundProbe& probe) const;
  void advance_shift(const FootAhead& foot, double seconds);
  void advance_errors(double seconds);
  void clear(const FootAhead& foot, double lower, double seconds, const GroundProbe& probe);
  void bear(const FootAhead& foot, double seconds);
  double part_of_way(const Vector2& place, double later) const;
  Footing on_way(const Vector2& place, double later) const;

  bool fresh_ = true, stood_ = false;
  Footing last_, next_;
  Footing plane_;                     // under it now, from the one to the other
  Approach error_;                    // of the height that is shown
  std::array<Approach, 2> turn_;      // likewise of the slope
  Vector2 beside_ = Vector2::Zero();  // how far it is to be moved
  std::array<Approach, 2> shift_;
  Approach clearance_;                                      // how high it steps over what is in its way, m
  double swing_time_ = 0, due_ = 0;                         // s since it stood, and until it stands
  double lift_ = 0, contact_weight_ = 1, sole_weight_ = 1;  // m; 0 .. 1
};

}  // namespace fragmotion

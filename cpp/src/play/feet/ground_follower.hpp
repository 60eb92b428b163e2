// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <utility>

#include "feet/foot_lock.hpp"
#include "feet/hips_on_ground.hpp"

namespace fragmotion {

/// Puts a body that moves on level ground at height 0 onto ground of any height: feet that stand, stand on it, turned
/// along its slope; feet on their way clear what is before them; the hips go along with both, as low as both legs
/// reach. Places from above stay as they are, but that a foot is set beside an edge. On level ground a pose is only
/// lifted, by 0 not at all. A body without legs follows the ground under its hips. Allocates nothing once it is made.
class GroundFollower {
 public:
  GroundFollower(std::shared_ptr<FootLock::Body> body, Ground ground)
      : body_(std::move(body)), ground_(std::move(ground)) {}

  /// Forgets where it was: the next pose stands on the ground under it, on the highest where several are one above the
  /// other, unless one of them is met from a step's height over 0.
  void reset();
  /// The ground may be another than it was, under a body that goes on.
  void forget_ground();
  /// Moves a pose that is shown `seconds` after the last one.
  void apply(WorldPose& pose, const FeetAhead& feet, double seconds);

  /// Whether feet stand on one level, and are to, but for what is not seen.
  bool is_even() const { return exact_ < 0.5; }
  /// The height of the ground under the body, m, as its hips follow it.
  double level() const { return level_; }
  /// Since reset(): s in which there was no ground under it. Meanwhile it goes on at the height that it had.
  double missed() const { return missed_; }

 private:
  friend struct PlayerState;

  void follow_hips(WorldPose& pose, double seconds, GroundProbe& probe);
  GroundProbe probe(const WorldPose& pose) const;
  bool advance_feet(const FeetAhead& feet, double seconds, GroundProbe& probe);
  void get_exact(const FeetAhead& feet, double seconds);
  double lower(int side, const FootAhead& foot) const;
  bool is_flat() const;
  Vector3 place_foot(int side, const FootAhead& foot);
  void sink(const FeetAhead& feet, const std::array<Vector3, 2>& ankles, double seconds);
  void raise_heel(int side, Vector3& ankle);
  void unfold(int side, Vector3& ankle) const;

  std::shared_ptr<FootLock::Body> body_;
  Ground ground_;
  FeetOnGround feet_;
  HipsOnGround hips_;
  std::array<Quaternion, 2> turns_, heels_;  // of the feet: along the slope, and up at the heel after that
  bool fresh_ = true;
  bool appears_ = false;  // by a reset, and not in a step
  double exact_ = 0;      // how exactly a sole stands on its footing: 0 (as high as it was captured) .. 1
  double level_ = 0, missed_ = 0;
};

}  // namespace fragmotion

// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "base/simd.hpp"
#include "feet/feet_ahead.hpp"
#include "feet/feet_constants.hpp"
#include "motion/pose.hpp"
#include "skeleton/two_bone_ik.hpp"

namespace fragmotion {

/// How steps differ from those of the motion, in the character frame: each foot is moved by `stride` times its place
/// from the hips, of a fore foot from the middle between the fore legs, and by `shift`, m.
struct StepEdit {
  Matrix2 stride = Matrix2::Zero();
  Vector2 shift = Vector2::Zero();

  /// The same in the world, of a body that faces `heading`.
  StepEdit in_world(double heading) const;
  /// By how much a foot is moved that is so far from the hips, m.
  Vector2 moved(const Vector2& from_hips) const { return stride * from_hips + shift; }
};

/// What feet do for a body at the moment.
struct Footwork {
  double turn = 0;      ///< rad/s by which it turns faster than its feet are set for.
  double clears = 0;    ///< How much of the way off the floor a free foot is lifted that is too low to go so fast.
  bool settles = true;  ///< Whether it steps out of a stride in which it stands: it is not about to go on.
};

/// Keeps planted feet where they are: the ball of a foot that is planted comes to rest and stays there, the leg follows
/// (two_bone_ik.hpp). Nor does it turn on the floor with the body: the leg turns in its hip, as far as hips do, and a
/// foot that swings is set ahead by half of what the body is to turn over it. A foot that is lifted, or that its motion
/// has left too far behind, goes back to its motion smoothly, with a step where that is far; but the only foot that
/// stands is kept for longer, and until the other one has come down whose turn it is. A ball that comes down at the
/// beginning of a contact of its motion, or rises at its end, goes with it: it is rolled over, not held in the air.
/// Where a leg would be a little too short, the heel of a foot that is left behind rises and the hips sink; where it
/// would be much too short, the foot steps on. A planted foot that hovers is lowered to the floor, and one that sets
/// off is lifted off it: a stitch from a stand would drag it. A body that has stood for a while in the middle of a
/// stride steps out of it. The feet of a four-legged body are two pairs, each like a biped's. Does nothing to a
/// skeleton without legs. Allocates nothing once it is made.
class FootLock {
 public:
  /// What the foot locks of one body share that are applied in turn: what never changes, and room to work in.
  struct Body {
    /// What filters do in the time between two poses, s, which is mostly as long as the last.
    struct Filters {
      double seconds = -1, rests = 0, settles = 0, sinks = 0, returns = 0;
      void set(double time, const FeetConstants& constants);
    };

    Body(const Kinematics& kinematics, const Legs& legs, const FeetConstants& constants = {});

    FeetConstants constants;
    Kinematics kinematics;
    Legs legs;
    double scale;
    std::array<std::vector<int>, kMostLegs> leg_bones;  // of each leg, from below the hips,
    std::vector<int> bones;                             // and of all
    PosedBones posed;
    Filters filters;
  };

  FootLock(const Kinematics& kinematics, const Legs& legs);
  explicit FootLock(std::shared_ptr<Body> body);

  /// All feet are free, and where their motion has them.
  void reset();

  /// Of a clip: what is shown, and what is a step's loading before and after it, between which a contact is told to
  /// begin or end. Where all are the same, feet are held in place for all of their contacts.
  struct Frames {
    std::size_t now, before, after;
  };

  /// Moves the legs of the pose that is shown `seconds` after the last one, and is, or is to become, a frame with these
  /// contacts. A foot that stands in that frame is planted once it is near the ground, where the
  /// edited step has it.
  void apply(WorldPose& pose, const Contacts& contacts, const Frames& frames, double seconds, const StepEdit& edit = {},
             const Footwork& work = {});

  bool locked(int side) const { return feet_[side].locked; }
  /// How far a locked foot goes on until it is at rest, m.
  Vector2 coming_to_rest(int side) const;
  /// Lets its memory be on its way to the processor.
  void prefetch() const { fragmotion::prefetch(feet_.data(), feet_.size()); }
  /// Until a foot that steps to where its motion has it is there, s; 0 where none does.
  double stepping(int side) const;

 private:
  friend struct PlayerState;

  // Places of a ball on the ground, m, and speeds, m/s.
  struct Foot {
    bool locked = false;
    bool steps = false;                                        // it was let go to step to where its motion has it
    Vector2 moved = Vector2::Zero(), shown = Vector2::Zero();  // last, by its motion and as it was shown
    Vector2 speed = Vector2::Zero();                           // of its motion
    // Locked: where, and its drift, which comes to rest. Free: how far from its motion when it was let go, and its
    // speed.
    Vector2 held = Vector2::Zero(), drift = Vector2::Zero();
    double height = 0;   // m over its floor, of its ball by its motion
    double holds = 1;    // the part of its motion's speed that a locked foot is kept from
    double free = 0;     // s since then
    double lowered = 0;  // m, while it is planted and would hover; under 0 while it is free and would be too low
    double raised = 0;   // rad, its heel, while the leg would be too short
    double faces = 0;    // rad, by its motion while it is planted
    double turn = 0, turn_speed = 0;  // rad by which it is turned from its motion; rad/s
    double stood = 0;                 // s that it was planted for, last
  };

  Vector3 under(int side, const WorldPose& pose) const;
  Vector2 away(int side, const Vector2& moved, bool planted, double seconds);
  double holds(int side, const Contacts& contacts, const Frames& frames, double height, double seconds) const;
  void lock(Foot& foot, const Vector2& shown, double seconds) const;
  void settle(bool settles, double seconds);
  void step_out();
  double step_height(const Foot& foot) const;
  double hovers(const Foot& foot, double over, double ball, double clear) const;
  double lowered(Foot& foot, double over, double hovers) const;
  void raise_heel(int side, const Vector3& ball, double longest, Vector3& ankle, double* rotations);
  void release(Foot& foot, const Vector2& away) const;
  void hold_turn(int side, double seconds);
  void return_turn(int side, double rate, double seconds);

  std::shared_ptr<Body> body_;
  std::vector<Foot> feet_;  // of each leg, or two where there is none
  bool fresh_ = true;       // no pose was shown yet
  double stood_ = 0;        // s that all feet are locked
  double sunk_ = 0;         // m that the hips are lowered
};

}  // namespace fragmotion

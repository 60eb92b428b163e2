// SPDX-License-Identifier: MIT
#pragma once

#include "character/character.hpp"
#include "fragments/hips_velocity.hpp"
#include "runtime/player_constants.hpp"
#include "runtime/step_sequence.hpp"

namespace fragmotion {

/// A member of a class, and what its costs are told by, all in one place of the memory.
struct Entrant {
  int fragment = 0, clip = 0;
  bool is_mirrored = false;
  float made = 0, entered = 0;  ///< Of perform() and of enter() what no control tells.
  float beside_usual = 0;       ///< tip_distance() of its beginning to the representative's.
  Control evident;
};

/// What it costs to play fragment g next, t seconds from now, in metres of Dis of a body whose tip_reach() is
/// kTunedReach:
///
///   cost = perform(g) + enter(g) + join(g) + wait ControlDis(Ev(what plays), Ev(class)) t
///   perform(g) = match ControlDis(Ev(g), control) + manner [g is synthesized]
///   enter(g) = unsteady |dv(g)| + hurried (1 - seconds(g) / a step's)+ + manner ([g or what is left is the mirrored
///              one of the two] + [g is of another take])
///   join(g) = Dis(what is left as it would go on, the beginning of g) + out_of_turn (feet that come down out of turn)
///
/// of which the class is the one that the policy tells, join and match are the factors of Eq. 2, and the rest is what a
/// viewer minds. The words are the weights in TransitionWeights; dv(g) is how the velocity changes from g's first tenth
/// of a second to its last, m/s of a 1.8 m character. With the successor a take goes on: nothing is joined nor entered,
/// and of how unsteady it is counts only by how much further from the control's velocity it ends than it begins, so
/// that a walk that is held does not go on in a step that brakes:
///
///   cost = perform(g) + unsteady (|v(last) - control| - |v(first) - control|)+
class TransitionCost {
 public:
  /// The character, in one of its styles, must outlive it.
  TransitionCost(const Character& character, const TransitionWeights& weights);

  /// Whether a fragment ends at half the speed at which it begins, or less.
  bool slows_down(int fragment) const;
  /// Of going on with a fragment as the successor under a control.
  float of_going_on(int fragment, const Control& control) const;
  /// The members of each class.
  std::vector<std::vector<Entrant>> entrants() const;
  /// perform() + enter() of one after another, mirrored or not, that is of a clip of this number.
  float of_entering(const Entrant& entrant, const Control& control, bool is_mirrored, int clip) const {
    return of_performing(entrant.evident, entrant.made, control) + entrant.entered +
           (entrant.is_mirrored != is_mirrored ? manner_ : 0) + (entrant.clip == clip ? 0 : manner_);
  }
  /// join() by a tip_distance() of places and of speeds, both of which it sums, for so many feet out of turn.
  float of_joining(float distance, int out_of_turn) const {
    return distance * per_distance_ + out_of_turn_ * out_of_turn;
  }

 private:
  float of_performing(const Control& evident, float made, const Control& control) const {
    return match_ * static_cast<float>(character_->space.distance(evident, control)) + made;
  }
  double strays(int fragment, const Control& control) const;

  const Character* character_;
  std::vector<EndVelocities> ends_;
  float match_, unsteady_, bent_, manner_, out_of_turn_, per_distance_;
  std::vector<float> made_, entered_;  // of each fragment: of perform() and of enter() what no control tells
};

}  // namespace fragmotion

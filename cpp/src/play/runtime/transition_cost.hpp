// SPDX-License-Identifier: MIT
#pragma once

#include "character/character.hpp"
#include "fragments/hips_velocity.hpp"
#include "runtime/player_constants.hpp"
#include "runtime/step_sequence.hpp"

namespace fragmotion {

/// What it costs to play fragment g next, t seconds from now, in metres of Dis of a body whose tip_reach() is
/// kTunedReach:
///
///   cost = perform(g) + enter(g) + join(g) + wait ControlDis(Ev(what plays), Ev(class)) t
///   perform(g) = match ControlDis(Ev(g), control) + unsteady strays(g) + made [g is synthesized]
///   enter(g) = hurried (1 - seconds(g) / a step's)+ + mirrored [g or what is left is the mirrored one of the two] +
///              other_take [g is of another take]
///   join(g) = Dis(what is left as it would go on, the beginning of g) + out_of_turn (feet that come down out of turn)
///
/// of which strays() is by how much, m/s of a 1.8 m character, g is further from the control's velocity in its last
/// tenth of a second than in its first, as a walk that is held must not go on in a step that brakes; the class is the
/// one that the policy tells, join and match are the factors of Eq. 2, and the rest is what a viewer minds. The words
/// are the weights in TransitionWeights. With the successor a take goes on: nothing is joined nor entered, so that it
/// costs perform() alone.
class TransitionCost {
 public:
  /// The character, in one of its styles, must outlive it.
  TransitionCost(const Character& character, const TransitionWeights& weights);

  /// perform() of a fragment under a control.
  float of_performing(int fragment, const Control& control) const;
  /// perform() + enter() of one after another, which is of the clip with these contacts.
  float of_entering(int fragment, const Control& control, const Fragment& left, const Contacts& of_left) const;
  /// join() by a tip_distance() of places and of speeds, both of which it sums, for so many feet out of turn.
  float of_joining(float distance, int out_of_turn) const {
    return distance * per_distance_ + out_of_turn_ * out_of_turn;
  }

 private:
  double strays(int fragment, const Control& control) const;

  const Character* character_;
  std::vector<EndVelocities> ends_;
  float match_, unsteady_, mirrored_, other_take_, out_of_turn_, per_distance_;
  std::vector<float> made_, entered_;  // of each fragment: of perform() and of enter() what no control tells
};

}  // namespace fragmotion

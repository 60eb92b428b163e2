// SPDX-License-Identifier: MIT
#pragma once

#include "character/character.hpp"
#include "runtime/player_constants.hpp"
#include "runtime/step_sequence.hpp"

namespace fragmotion {

/// What it costs to play fragment g next, t seconds from now, in metres of Dis of a body whose tip_reach() is
/// kTunedReach:
///
///   cost = perform(g) + enter(g) + join(g) + wait ControlDis(Ev(what plays), Ev(class)) t
///   perform(g) = match ControlDis(Ev(g), control) + made [g is synthesized]
///   enter(g) = unsteady |dv(g)| + hurried (1 - seconds(g) / a step's)+ + mirrored [g or what is left is the mirrored
///              one of the two] + other_take [g is of another take]
///   join(g) = Dis(what is left as it would go on, the beginning of g) + out_of_turn (feet that come down out of turn)
///
/// of which the class is the one that the policy tells, join and match are the factors of Eq. 2, and the rest is what a
/// viewer minds. The words are the weights in TransitionWeights. With the successor a take goes on: nothing is joined
/// nor entered, so that it costs perform() alone.
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
  const Character* character_;
  float match_, mirrored_, other_take_, out_of_turn_, per_distance_;
  std::vector<float> made_, entered_;  // of each fragment: of perform() and of enter() what no control tells
};

}  // namespace fragmotion

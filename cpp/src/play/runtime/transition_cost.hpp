// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <vector>

#include "character/character.hpp"
#include "fragments/body_tips.hpp"
#include "fragments/hips_velocity.hpp"
#include "runtime/player_constants.hpp"
#include "runtime/step_sequence.hpp"

namespace fragmotion {

/// The members of a class or of a gait, and what their costs are told by, each beside the others': they are told
/// together. Rows are padded to whole blocks of kLanes, with what costs infinitely much.
struct Entrants {
  int count = 0, stride = 0, representative = -1;
  std::vector<int> numbers;      ///< [3, stride]: fragments, clips, and 1 where it is a mirror image
  std::vector<float> costs;      ///< [3, stride]: of perform() and of enter() what no control tells, and beside_usual()
  std::vector<double> evidents;  ///< [4, stride]: x, y, turn and jump

  int fragment(int i) const { return numbers[i]; }
  /// tip_distance() of its beginning to the representative's.
  float beside_usual(int i) const { return costs[2 * stride + i]; }
  Control evident(int i) const {
    return {evidents[i], evidents[stride + i], evidents[2 * stride + i], evidents[3 * stride + i]};
  }
};

/// Which of a row of costs in whole blocks of kLanes is the first one that is the least.
int first_of_least(const float* costs, int stride);

/// What members of a class enter after, mirrored or not, of a clip of this number; under which control, and whether
/// those alone may that jump, or do not, as is wanted, and that answer() it.
struct Entry {
  Control control;
  bool is_mirrored = false;
  int clip = -1;
  bool matches = false, goes = false;
};

/// What it costs to play fragment g next, t seconds from now, in metres of Dis of a body whose tip_reach() is
/// kTunedReach:
///
///   cost = perform(g) + enter(g) + join(g) + wait ControlDis(Ev(what plays), Ev(class)) t
///   perform(g) = match ControlDis(Ev(g), control) + bent |turn of g - turn of control| + manner [g is synthesized]
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

  /// Whether the take may go on with a fragment under a control: the policy may play it, and it jumps or does not, and
  /// goes, or stands or brakes and turns or does not, as asked.
  bool may_go_on(int fragment, const Control& control) const;
  /// Of going on with a fragment as the successor under a control.
  float of_going_on(int fragment, const Control& control) const;
  /// perform() of what begins with a fragment and is evident of this.
  float of_performing(const Control& evident, int fragment, const Control& control) const {
    return of_performing(evident, made_[fragment], control);
  }
  /// A step, of entering a fragment where one of its take would go on, every so many seconds.
  float of_closing(int next, int fragment, double seconds) const;
  /// The tip_distance() between the beginnings of two fragments.
  float beside(int fragment, int other) const;
  /// Of which one is the representative.
  Entrants entrants(const std::vector<int>& members, int representative) const;
  /// Writes perform() + enter() of each, infinite where it may not be entered, to a row of costs; in another it works.
  void of_entering(const Entrants& entrants, const Entry& entry, double* __restrict apart,
                   float* __restrict costs) const;
  /// The first block, from that of a member on, of which any may cost less than `most` where these costs are known, and
  /// the representative joins by a tip_distance() that is `usual`: by the triangle inequality the beginning of another
  /// is at least as far as that, less what is between the two. Beyond all members where there is none.
  int next_under(const Entrants& entrants, int first, const float* costs, float usual, float most) const;
  /// join() by a tip_distance() of places and of speeds, both of which it sums, for so many feet out of turn.
  float of_joining(float distance, int out_of_turn) const {
    return distance * per_distance_ + out_of_turn_ * out_of_turn;
  }

 private:
  float of_performing(const Control& evident, float made, const Control& control) const {
    return match_ * static_cast<float>(character_->space.distance(evident, control)) +
           bent_ * static_cast<float>(std::abs(evident.turn - control.turn)) + made;
  }
  double strays(int fragment, const Control& control) const;

  const Character* character_;
  std::vector<EndVelocities> ends_;
  float match_, unsteady_, bent_, manner_, out_of_turn_, per_distance_;
  std::vector<float> made_, entered_;  // of each fragment: of perform() and of enter() what no control tells
};

}  // namespace fragmotion

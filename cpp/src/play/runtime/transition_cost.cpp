// SPDX-License-Identifier: MIT
#include "runtime/transition_cost.hpp"

#include <algorithm>
#include <cmath>

#include "fragments/body_tips.hpp"

namespace fragmotion {
namespace {

constexpr double kStep = 0.4;  // s

}  // namespace

TransitionCost::TransitionCost(const Character& character, const TransitionWeights& weights)
    : character_(&character),
      ends_(end_velocities(character.pool)),
      match_(static_cast<float>(weights.match)),
      unsteady_(static_cast<float>(weights.unsteady * standard_scale(character.pool.skeleton))),
      bent_(static_cast<float>(weights.bent)),
      mirrored_(static_cast<float>(weights.mirrored)),
      other_take_(static_cast<float>(weights.other_take)),
      out_of_turn_(static_cast<float>(weights.out_of_turn)),
      per_distance_(static_cast<float>(kTunedReach / tip_reach(character.pool.skeleton) / 2)) {
  const PackedPool& pool = character.pool;
  for (std::size_t f = 0; f < pool.fragments.size(); ++f) {
    const Fragment& fragment = pool.fragments[f];
    const double lacks = std::max(0.0, 1 - pool.seconds(fragment) / kStep),
                 changes = (ends_[f].last - ends_[f].first).norm();
    made_.push_back(is_made(fragment.origin) ? static_cast<float>(weights.made) : 0);
    entered_.push_back(static_cast<float>(weights.hurried * lacks) + unsteady_ * static_cast<float>(changes));
  }
}

bool TransitionCost::slows_down(int fragment) const {
  return ends_[fragment].last.norm() <= ends_[fragment].first.norm() / 2;
}

double TransitionCost::strays(int fragment, const Control& control) const {
  const Vector2 asked{control.x, control.y};
  const EndVelocities& ends = ends_[fragment];
  return std::max(0.0, (ends.last - asked).norm() - (ends.first - asked).norm());
}

float TransitionCost::of_performing(int fragment, const Control& control) const {
  const Control& evident = character_->pool.fragments[fragment].evident;
  return match_ * static_cast<float>(character_->space.distance(evident, control)) + made_[fragment];
}

float TransitionCost::of_going_on(int fragment, const Control& control) const {
  const double turned = std::abs(character_->pool.fragments[fragment].evident.turn - control.turn);
  return of_performing(fragment, control) + unsteady_ * static_cast<float>(strays(fragment, control)) +
         bent_ * static_cast<float>(turned);
}

float TransitionCost::of_entering(int fragment, const Control& control, const Fragment& left,
                                  const Contacts& of_left) const {
  const Fragment& f = character_->pool.fragments[fragment];
  const bool flips = (f.origin == Origin::mirrored) != (left.origin == Origin::mirrored);
  const bool stays = &character_->contacts[f.clip] == &of_left;
  return of_performing(fragment, control) + entered_[fragment] + (flips ? mirrored_ : 0) + (stays ? 0 : other_take_);
}

}  // namespace fragmotion

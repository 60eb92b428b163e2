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
      manner_(static_cast<float>(weights.manner)),
      out_of_turn_(static_cast<float>(weights.out_of_turn)),
      per_distance_(static_cast<float>(kTunedReach / tip_reach(character.pool.skeleton) / 2)) {
  const PackedPool& pool = character.pool;
  for (std::size_t f = 0; f < pool.fragments.size(); ++f) {
    const Fragment& fragment = pool.fragments[f];
    const double lacks = std::max(0.0, 1 - pool.seconds(fragment) / kStep),
                 changes = (ends_[f].last - ends_[f].first).norm();
    made_.push_back(is_made(fragment.origin) ? manner_ : 0);
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

float TransitionCost::of_going_on(int fragment, const Control& control) const {
  const Control& evident = character_->pool.fragments[fragment].evident;
  const double turned = std::abs(evident.turn - control.turn);
  return of_performing(evident, made_[fragment], control) + unsteady_ * static_cast<float>(strays(fragment, control)) +
         bent_ * static_cast<float>(turned);
}

std::vector<std::vector<Entrant>> TransitionCost::entrants() const {
  const Character& c = *character_;
  const std::size_t row = c.entry_poses.size() / c.pool.fragments.size();
  const auto entry = [&](int fragment) { return c.entry_poses.data() + row * fragment; };
  std::vector<std::vector<Entrant>> all(c.classes.count);
  for (std::size_t i = 0; i < c.pool.fragments.size(); ++i) {
    const int fragment = static_cast<int>(i), label = c.classes.labels[i];
    const Fragment& f = c.pool.fragments[i];
    const float beside =
        tip_distance(entry(fragment), entry(c.classes.representatives[label]), static_cast<int>(row) / 3);
    all[label].push_back({fragment, f.clip, f.origin == Origin::mirrored, made_[i], entered_[i], beside, f.evident});
  }
  return all;
}

}  // namespace fragmotion

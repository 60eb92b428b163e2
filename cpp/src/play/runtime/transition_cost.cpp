// SPDX-License-Identifier: MIT
#include "runtime/transition_cost.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/vectorised.hpp"
#include "motion/contacts.hpp"
#include "policy/answer.hpp"

namespace fragmotion {
namespace {

constexpr double kStep = 0.4;  // s

}  // namespace

[[gnu::cold]] TransitionCost::TransitionCost(const Character& character, const TransitionWeights& weights)
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

bool TransitionCost::may_go_on(int fragment, const Control& control) const {
  const Character& c = *character_;
  const Control& evident = c.pool.fragments[fragment].evident;
  const auto stands = [&] {
    if (ControlSpace::turns(evident.turn - control.turn)) return false;
    const bool slows_down = ends_[fragment].last.norm() <= ends_[fragment].first.norm() / 2;
    return slows_down || evident.speed() * c.space.scale() <= kMoving;
  };
  if (!(c.space.asks_to_go(control) ? answers(evident, control) : stands())) return false;
  const bool is_excluded =
      c.quality.match[static_cast<std::size_t>(c.classes.labels[fragment]) * c.quality.controls] == 0;
  return !is_excluded && matches_jump(evident, control);
}

double TransitionCost::strays(int fragment, const Control& control) const {
  const Vector2 asked{control.x, control.y};
  const EndVelocities& ends = ends_[fragment];
  return std::max(0.0, (ends.last - asked).norm() - (ends.first - asked).norm());
}

float TransitionCost::of_going_on(int fragment, const Control& control) const {
  const Control& evident = character_->pool.fragments[fragment].evident;
  return of_performing(evident, made_[fragment], control) + unsteady_ * static_cast<float>(strays(fragment, control));
}

float TransitionCost::beside(int fragment, int other) const {
  const Character& c = *character_;
  const std::size_t row = c.entry_poses.size() / c.pool.fragments.size();
  const float* entries = c.entry_poses.data();
  return tip_distance(entries + row * fragment, entries + row * other, static_cast<int>(row) / 3);
}

float TransitionCost::of_closing(int next, int fragment, double seconds) const {
  if (next == fragment) return 0;
  return static_cast<float>(kStep / seconds) * (entered_[fragment] + of_joining(beside(next, fragment), 0));
}

[[gnu::cold]] Entrants TransitionCost::entrants(const std::vector<int>& members, int representative) const {
  Entrants e;
  e.count = static_cast<int>(members.size());
  e.stride = padded(e.count);
  e.representative = representative;
  e.numbers = std::vector<int>(std::size_t{3} * e.stride);
  e.costs = std::vector<float>(std::size_t{3} * e.stride, std::numeric_limits<float>::infinity());
  e.evidents = std::vector<double>(std::size_t{4} * e.stride);
  for (int i = 0; i < e.count; ++i) {
    const int fragment = members[i];
    const Fragment& f = character_->pool.fragments[fragment];
    int* number = &e.numbers[i];
    for (const int value : {fragment, f.clip, f.origin == Origin::mirrored ? 1 : 0})
      *number = value, number += e.stride;
    float* cost = &e.costs[i];
    for (const float value : {made_[fragment], entered_[fragment], beside(fragment, representative)})
      *cost = value, cost += e.stride;
    double* evident = &e.evidents[i];
    for (const double value : {f.evident.x, f.evident.y, f.evident.turn, f.evident.jump})
      *evident = value, evident += e.stride;
  }
  return e;
}

FRAGMOTION_VECTORISED void TransitionCost::of_entering(const Entrants& entrants, const Entry& entry,
                                                       double* __restrict apart, float* __restrict costs) const {
  const float infinite = std::numeric_limits<float>::infinity();
  const int count = entrants.stride / kLanes * kLanes;
  const Control wanted = entry.control;
  const ControlMetric metric = character_->space.metric();
  const double *x = entrants.evidents.data(), *y = x + count, *turn = y + count, *jump = turn + count;
  for (int i = 0; i < count; ++i) apart[i] = metric({x[i], y[i], turn[i], jump[i]}, wanted);
  const int *clip = entrants.numbers.data() + count, *mirrored = clip + count;
  const float *made = entrants.costs.data(), *entered = made + count;
  const float match = match_, manner = manner_, bent = bent_;
  for (int i = 0; i < count; ++i) {
    const float side = mirrored[i] == (entry.is_mirrored ? 1 : 0) ? 0 : manner,
                take = clip[i] == entry.clip ? 0 : manner;
    const auto turned = static_cast<float>(std::abs(turn[i] - wanted.turn));
    costs[i] = match * static_cast<float>(apart[i]) + bent * turned + made[i] + entered[i] + side + take;
  }
  if (entry.matches) {
    for (int i = 0; i < count; ++i) costs[i] = matches_jump({0, 0, 0, jump[i]}, wanted) ? costs[i] : infinite;
  }
  if (entry.goes) {
    for (int i = 0; i < count; ++i) costs[i] = goes_along(x[i], y[i], wanted) ? costs[i] : infinite;
  }
}

int first_of_least(const float* costs, int stride) {
  float least[kLanes];
  std::copy_n(costs, kLanes, least);
  for (int first = kLanes; first < stride; first += kLanes) {
    for (int i = 0; i < kLanes; ++i) least[i] = costs[first + i] < least[i] ? costs[first + i] : least[i];
  }
  const float found = *std::min_element(least, least + kLanes);
  for (int first = 0; first < stride; first += kLanes) {
    int equal = 0;
    for (int i = first; i < first + kLanes; ++i) equal |= costs[i] == found ? 1 : 0;
    if (equal != 0) return static_cast<int>(std::find(costs + first, costs + first + kLanes, found) - costs);
  }
  return 0;
}

FRAGMOTION_VECTORISED int TransitionCost::next_under(const Entrants& entrants, int first, const float* costs,
                                                     float usual, float most) const {
  const float* beside = &entrants.costs[std::size_t{2} * entrants.stride];
  const float per_distance = per_distance_;
  for (; first < entrants.stride; first += kLanes) {
    int under = 0;
    for (int i = first; i < first + kLanes; ++i)
      under |= costs[i] + std::max(0.0F, usual - beside[i]) * per_distance < most ? 1 : 0;
    if (under != 0) break;
  }
  return first;
}

}  // namespace fragmotion

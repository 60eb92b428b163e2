// SPDX-License-Identifier: MIT
#include "runtime/transition_cost.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/vectorised.hpp"
#include "policy/answer.hpp"

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

float TransitionCost::of_going_on(int fragment, const Control& control) const {
  const Control& evident = character_->pool.fragments[fragment].evident;
  const double turned = std::abs(evident.turn - control.turn);
  return of_performing(evident, made_[fragment], control) + unsteady_ * static_cast<float>(strays(fragment, control)) +
         bent_ * static_cast<float>(turned);
}

std::vector<Entrants> TransitionCost::entrants() const {
  const Character& c = *character_;
  const std::size_t row = c.entry_poses.size() / c.pool.fragments.size();
  const auto entry = [&](int fragment) { return c.entry_poses.data() + row * fragment; };
  std::vector<Entrants> all;
  for (const std::vector<int>& members : c.classes.members()) {
    Entrants& e = all.emplace_back();
    const float* usual = entry(c.classes.representatives[all.size() - 1]);
    e.count = static_cast<int>(members.size());
    for (const int fragment : members) {
      const Fragment& f = c.pool.fragments[fragment];
      e.fragment.push_back(fragment);
      e.clip.push_back(f.clip);
      e.is_mirrored.push_back(f.origin == Origin::mirrored ? 1 : 0);
      e.made.push_back(made_[fragment]);
      e.entered.push_back(entered_[fragment]);
      e.beside_usual.push_back(tip_distance(entry(fragment), usual, static_cast<int>(row) / 3));
      e.x.push_back(f.evident.x);
      e.y.push_back(f.evident.y);
      e.turn.push_back(f.evident.turn);
      e.jump.push_back(f.evident.jump);
    }
    const int padded_count = padded(e.count);
    for (std::vector<int>* row : {&e.fragment, &e.clip, &e.is_mirrored}) row->resize(padded_count);
    for (std::vector<float>* row : {&e.entered, &e.beside_usual}) row->resize(padded_count);
    for (std::vector<double>* row : {&e.x, &e.y, &e.turn, &e.jump}) row->resize(padded_count);
    e.made.resize(padded_count, std::numeric_limits<float>::infinity());
  }
  return all;
}

FRAGMOTION_VECTORISED void TransitionCost::of_entering(const Entrants& entrants, const Entry& entry,
                                                       double* __restrict apart, double* __restrict barred,
                                                       float* __restrict costs) const {
  constexpr double kBarred = std::numeric_limits<double>::infinity();
  const int count = entrants.padded_count() / kLanes * kLanes;
  const Control wanted = entry.control;
  const ControlMetric metric = character_->space.metric();
  const double *x = entrants.x.data(), *y = entrants.y.data(), *turn = entrants.turn.data(),
               *jump = entrants.jump.data();
  for (int i = 0; i < count; ++i) apart[i] = metric({x[i], y[i], turn[i], jump[i]}, wanted);
  for (int i = 0; i < count; ++i) barred[i] = 0;
  if (entry.matches) {
    for (int i = 0; i < count; ++i) barred[i] = matches_jump({0, 0, 0, jump[i]}, wanted) ? barred[i] : kBarred;
  }
  if (entry.goes) {
    for (int i = 0; i < count; ++i) barred[i] = goes_along(x[i], y[i], wanted) ? barred[i] : kBarred;
  }
  const int *mirrored = entrants.is_mirrored.data(), *clip = entrants.clip.data();
  const float *made = entrants.made.data(), *entered = entrants.entered.data();
  const float match = match_, of_side = mirrored_, of_take = other_take_;
  for (int i = 0; i < count; ++i) {
    const float side = mirrored[i] == (entry.is_mirrored ? 1 : 0) ? 0 : of_side,
                take = clip[i] == entry.clip ? 0 : of_take;
    costs[i] =
        match * static_cast<float>(apart[i]) + made[i] + entered[i] + side + take + static_cast<float>(barred[i]);
  }
}

FRAGMOTION_VECTORISED bool TransitionCost::any_under(const Entrants& entrants, int first, const float* costs,
                                                     float usual, float most) const {
  const float* beside = &entrants.beside_usual[first];
  const float per_distance = per_distance_;
  int under = 0;
  for (int i = 0; i < kLanes; ++i)
    under |= costs[first + i] + std::max(0.0F, usual - beside[i]) * per_distance < most ? 1 : 0;
  return under != 0;
}

}  // namespace fragmotion

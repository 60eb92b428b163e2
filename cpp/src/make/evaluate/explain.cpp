// SPDX-License-Identifier: MIT
#include "evaluate/explain.hpp"

#include <algorithm>
#include <stdexcept>

#include "policy/iterate.hpp"
#include "policy/optimal.hpp"

namespace fragmotion {
Explainer::Explainer(std::shared_ptr<const Character> character, const std::string& policy)
    : character_(std::move(character)),
      policy_(character_->policy(policy)),
      poses_(trajectories(character_->pool, 2)),
      members_(character_->classes.members()),
      future_value_(future_values(character_->quality, policy_, character_->control_model)) {}

std::vector<Alternative> Explainer::operator()(int from, int control) const {
  const Quality& quality = character_->quality;
  if (from < 0 || from >= quality.classes) {
    throw std::invalid_argument("class " + std::to_string(from) + " does not exist");
  }
  check_controls({control}, quality.controls);
  std::vector<Alternative> ranked;
  for (int next = 0; next < quality.classes; ++next) {
    const auto q = static_cast<std::size_t>(next);
    ranked.push_back({next, quality.smoothness[static_cast<std::size_t>(from) * quality.classes + q],
                      quality.match[q * quality.controls + control],
                      future_value_[static_cast<std::size_t>(control) * quality.classes + q],
                      nearest(from, next, control)});
  }
  std::stable_sort(ranked.begin(), ranked.end(),
                   [](const Alternative& a, const Alternative& b) { return a.value() > b.value(); });
  return ranked;
}

std::vector<int> Explainer::nearest(int from, int next, int control) const {
  const Character& c = *character_;
  const int left = c.classes.representatives[from];
  std::vector<std::pair<double, int>> worse;
  for (const int f : members_[next]) {
    const double off = c.space.distance(c.pool.fragments[f].evident, c.space.point(control));
    worse.emplace_back((1 + off) * (1 + transition_distance(poses_, left, f)), f);
  }
  const auto kept = worse.begin() + std::min<std::ptrdiff_t>(kNearest, static_cast<std::ptrdiff_t>(worse.size()));
  std::partial_sort(worse.begin(), kept, worse.end());
  std::vector<int> fragments;
  std::transform(worse.begin(), kept, std::back_inserter(fragments), [](const auto& each) { return each.second; });
  return fragments;
}

}  // namespace fragmotion

// SPDX-License-Identifier: MIT
#include "build/exclude_classes.hpp"

#include <algorithm>
#include <memory>
#include <stdexcept>

#include "policy/bridge.hpp"
#include "policy/iterate.hpp"

namespace fragmotion {
namespace {

std::vector<bool> allowed_classes(int count, const std::vector<int>& excluded) {
  std::vector<bool> allowed(count, true);
  for (const int k : excluded) {
    if (k < 0 || k >= count) throw std::invalid_argument("class " + std::to_string(k) + " does not exist");
    allowed[k] = false;
  }
  if (std::find(allowed.begin(), allowed.end(), true) == allowed.end()) {
    throw std::invalid_argument("all classes are excluded");
  }
  return allowed;
}

// The allowed class of the greatest value after `from`.
int best_of(const std::vector<bool>& allowed, const Quality& quality, const std::vector<double>& future_value, int from,
            int control) {
  const auto value = [&](int next) {
    return quality(from, next, control) + future_value[static_cast<std::size_t>(control) * quality.classes + next];
  };
  int best = -1;
  for (int next = 0; next < quality.classes; ++next) {
    if (allowed[next] && (best < 0 || value(next) > value(best))) best = next;
  }
  return best;
}

void avoid(const std::vector<bool>& allowed, const Character& whole, Policy& policy) {
  const auto is_allowed = [&](int next) { return allowed[next]; };
  if (std::all_of(policy.next.begin(), policy.next.end(), is_allowed)) return;
  const std::vector<double> future_value = future_values(whole.quality, policy, whole.control_model);
  for (int from = 0; from < policy.classes; ++from) {
    for (int c = 0; c < policy.controls; ++c) {
      int& next = policy.next[static_cast<std::size_t>(from) * policy.controls + c];
      if (!allowed[next]) next = best_of(allowed, whole.quality, future_value, from, c);
    }
  }
}

Character first_style_without(const Character& character, const std::vector<int>& excluded) {
  const std::vector<bool> allowed = allowed_classes(character.classes.count, excluded);
  Character result = character;
  for (Policy& policy : result.policies) avoid(allowed, character, policy);
  for (const int k : excluded) leave_out(k, result.quality);
  result.bridges = stand_bridges(result.pool.fragments, trajectories(result.pool, 2), result.classes, result.space,
                                 kBridgeDistance, allowed);
  repair_policies(result);
  return result;
}

}  // namespace

Character without_classes(const Character& character, const std::vector<int>& excluded, int style) {
  check_style(character, style);
  if (style == 0) return first_style_without(character, excluded);
  Character result = character;
  result.styles[style - 1] =
      std::make_shared<const Character>(first_style_without(character.in_style(style), excluded));
  return result;
}

}  // namespace fragmotion

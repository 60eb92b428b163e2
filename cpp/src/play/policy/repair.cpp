// SPDX-License-Identifier: MIT
#include "policy/repair.hpp"

namespace fragmotion {
namespace {

// Whether what would play goes back from where is wanted, though what plays goes there.
bool turns_back(const Control& playing, const Control& next, const Control& wanted) {
  const auto along = [&](const Control& ev) { return ev.x * wanted.x + ev.y * wanted.y; };
  return along(playing) > 0 && along(next) < 0;
}

}  // namespace

void repair_policy(Policy& policy, const Quality& quality, const ControlSpace& space,
                   const std::vector<Control>& evident) {
  std::vector<int> led_to;
  for (int k = 0; k < policy.classes; ++k) {
    if (policy.leads_to(k)) led_to.push_back(k);
  }
  for (int from = 0; from < policy.classes; ++from) {
    for (int control = 0; control < policy.controls; ++control) {
      const Control& wanted = space.point(control);
      const auto suits = [&](int k) {
        return matches_jump(evident[k], wanted) && !turns_back(evident[from], evident[k], wanted);
      };
      int& next = policy.next[static_cast<std::size_t>(from) * policy.controls + control];
      if (suits(next)) continue;
      double best = 0;
      for (const int k : led_to) {
        const double match = quality.match[static_cast<std::size_t>(k) * quality.controls + control],
                     worth = quality(from, k, control) * match;
        if (suits(k) && worth > best) best = worth, next = k;
      }
    }
  }
}

}  // namespace fragmotion

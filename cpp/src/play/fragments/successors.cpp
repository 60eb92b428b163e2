// SPDX-License-Identifier: MIT
#include "fragments/successors.hpp"

#include <map>
#include <tuple>

namespace fragmotion {
namespace {

// Gaits and stands are made as cycles (synthesis.hpp); a hop is none.
bool is_of_cycle(const Fragment& f) { return f.origin == Origin::transformed && !f.evident.jumps(); }

}  // namespace

std::vector<int> successors(const std::vector<Fragment>& fragments) {
  const auto place = [](const Fragment& f, int frame) { return std::tuple(f.clip, f.origin, frame); };
  std::map<std::tuple<int, Origin, int>, int> beginning;
  std::map<int, int> first_of_cycle;
  for (std::size_t f = 0; f < fragments.size(); ++f) {
    const Fragment& fragment = fragments[f];
    const int number = static_cast<int>(f);
    beginning.emplace(place(fragment, fragment.first_played()), number);
    if (!is_of_cycle(fragment)) continue;
    const auto [first, fresh] = first_of_cycle.emplace(fragment.clip, number);
    if (fragment.begin < fragments[first->second].begin) first->second = number;
  }
  std::vector<int> next;
  for (const Fragment& f : fragments) {
    const auto found = beginning.find(place(f, f.last_played()));
    const int again = is_of_cycle(f) ? first_of_cycle[f.clip] : -1;
    next.push_back(found == beginning.end() ? again : found->second);
  }
  return next;
}

}  // namespace fragmotion

// SPDX-License-Identifier: MIT
#include "fragments/successors.hpp"

#include <algorithm>
#include <map>
#include <tuple>

namespace fragmotion {
namespace {

// Gaits and stands are made as cycles (synthesis.hpp); a hop is none.
bool is_of_cycle(const Fragment& f) { return f.origin == Origin::transformed && !f.evident.jumps(); }

}  // namespace

std::vector<int> successors(const std::vector<Fragment>& fragments) {
  const auto place = [](const Fragment& f, int frame, int number) {
    return std::tuple(f.clip, f.origin, frame, number);
  };
  std::vector<std::tuple<int, Origin, int, int>> beginnings;
  std::map<int, int> first_of_cycle;
  for (std::size_t f = 0; f < fragments.size(); ++f) {
    const Fragment& fragment = fragments[f];
    const int number = static_cast<int>(f);
    beginnings.push_back(place(fragment, fragment.first_played(), number));
    if (!is_of_cycle(fragment)) continue;
    const auto [first, fresh] = first_of_cycle.emplace(fragment.clip, number);
    if (fragment.begin < fragments[first->second].begin) first->second = number;
  }
  std::sort(beginnings.begin(), beginnings.end());
  std::vector<int> next;
  for (const Fragment& f : fragments) {
    const auto found = std::lower_bound(beginnings.begin(), beginnings.end(), place(f, f.last_played(), 0));
    const int number = found == beginnings.end() ? -1 : std::get<3>(*found);
    const bool begins_there = number >= 0 && *found == place(f, f.last_played(), number);
    next.push_back(begins_there ? number : is_of_cycle(f) ? first_of_cycle[f.clip] : -1);
  }
  return next;
}

}  // namespace fragmotion

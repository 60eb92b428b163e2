// SPDX-License-Identifier: MIT
#include "fragments/successors.hpp"

#include <algorithm>
#include <limits>
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
  for (std::size_t f = 0; f < fragments.size(); ++f) {
    beginnings.push_back(place(fragments[f], fragments[f].first_played(), static_cast<int>(f)));
  }
  std::sort(beginnings.begin(), beginnings.end());
  std::vector<int> next;
  for (const Fragment& f : fragments) {
    const auto first_from = [&](int frame) {
      return std::lower_bound(beginnings.begin(), beginnings.end(), place(f, frame, 0));
    };
    auto found = first_from(f.last_played());
    const bool goes_on = found != beginnings.end() && *found == place(f, f.last_played(), std::get<3>(*found));
    if (!goes_on && is_of_cycle(f)) found = first_from(std::numeric_limits<int>::min());
    next.push_back(goes_on || is_of_cycle(f) ? std::get<3>(*found) : -1);
  }
  return next;
}

}  // namespace fragmotion

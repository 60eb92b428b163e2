// SPDX-License-Identifier: MIT
#include "fragments/successors.hpp"

#include <map>
#include <tuple>

namespace fragmotion {

std::vector<int> successors(const std::vector<Fragment>& fragments) {
  const auto place = [](const Fragment& f, int frame) { return std::tuple(f.clip, f.origin, frame); };
  std::map<std::tuple<int, Origin, int>, int> beginning;
  for (std::size_t f = 0; f < fragments.size(); ++f) {
    beginning.emplace(place(fragments[f], fragments[f].first_played()), static_cast<int>(f));
  }
  std::vector<int> next;
  for (const Fragment& f : fragments) {
    const auto found = beginning.find(place(f, f.last_played()));
    next.push_back(found == beginning.end() ? -1 : found->second);
  }
  return next;
}

}  // namespace fragmotion

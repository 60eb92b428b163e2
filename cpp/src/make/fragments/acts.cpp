// SPDX-License-Identifier: MIT
#include "fragments/acts.hpp"

#include <algorithm>
#include <limits>
#include <vector>

#include "skeleton/bone_names.hpp"

namespace fragmotion {
namespace {

// Leaves out the acts of one origin: a mirror image has a word more in its name.
void drop_acts(FragmentPool& pool, const ControlSpace& space, Origin origin) {
  std::vector<char> only_stands(pool.clips.size(), 0);
  for (const Fragment& f : pool.fragments) only_stands[f.clip] = f.origin == origin;
  for (const Fragment& f : pool.fragments) only_stands[f.clip] &= space.stands(f.evident) && !f.evident.jumps();
  std::vector<int> words(pool.clips.size(), -1);
  int fewest = std::numeric_limits<int>::max();
  for (std::size_t c = 0; c < words.size(); ++c) {
    if (!only_stands[c]) continue;
    words[c] = words_beside_idle(pool.clips[c].name);
    if (words[c] >= 0) fewest = std::min(fewest, words[c]);
  }
  if (fewest == std::numeric_limits<int>::max()) return;
  const auto of_act = [&](const Fragment& f) { return only_stands[f.clip] && words[f.clip] != fewest; };
  pool.fragments.erase(std::remove_if(pool.fragments.begin(), pool.fragments.end(), of_act), pool.fragments.end());
}

}  // namespace

int words_beside_idle(const std::string& name) {
  for (std::size_t begin = 0; begin <= name.size();) {
    const std::size_t end = std::min(name.find_first_of(":|", begin), name.size());
    const BoneName part = read_names({name.substr(begin, end - begin)})[0];
    if (has_any_word(part, {"idle"})) return static_cast<int>(part.words.size()) - 1;
    begin = end + 1;
  }
  return -1;
}

void drop_acts(FragmentPool& pool, const ControlSpace& space) {
  for (const Origin origin : {Origin::captured, Origin::mirrored}) drop_acts(pool, space, origin);
}

}  // namespace fragmotion

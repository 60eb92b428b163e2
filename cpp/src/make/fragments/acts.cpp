// SPDX-License-Identifier: MIT
#include "fragments/acts.hpp"

#include <algorithm>
#include <limits>
#include <vector>

#include "fragments/standing.hpp"
#include "skeleton/bone_names.hpp"

namespace fragmotion {
namespace {

// The acts among the clips of one origin: a mirror image has a word more in its name.
class Acts {
 public:
  Acts(const FragmentPool& pool, const ControlSpace& space, Origin origin)
      : pool_(pool), space_(space), origin_(origin), rest_(pool.clips.size(), 0), moves_(pool.clips.size(), 0) {
    for (const Fragment& f : pool.fragments) {
      if (f.origin == origin) (rests(f) ? rest_ : moves_)[f.clip] += pool.seconds(f);
      if (f.origin == origin && f.evident.jumps()) moves_[f.clip] = std::numeric_limits<double>::infinity();
    }
    keep_idles();
  }

  bool holds(const Fragment& f) const { return f.origin == origin_ && has_others_ && is_act(f.clip) && rests(f); }

 private:
  bool rests(const Fragment& f) const {
    return space_.point(space_.nearest(f.evident)).speed() == 0 && !space_.turns(f.evident.turn) && !f.evident.jumps();
  }

  bool is_act(int clip) const { return rest_[clip] > moves_[clip]; }

  // Idles are none; and there are others where there is an idle, or where those who move rest for long.
  void keep_idles() {
    std::vector<int> words;
    int fewest = std::numeric_limits<int>::max();
    double rest = 0;
    for (std::size_t c = 0; c < rest_.size(); ++c) {
      words.push_back(is_act(c) ? words_beside_idle(pool_.clips[c].name) : -1);
      if (words[c] >= 0) fewest = std::min(fewest, words[c]);
      if (!is_act(c)) rest += rest_[c];
    }
    for (std::size_t c = 0; c < rest_.size(); ++c) {
      if (words[c] == fewest) moves_[c] = std::numeric_limits<double>::infinity();
    }
    has_others_ = fewest < std::numeric_limits<int>::max() || rest >= kStandsLong;
  }

  const FragmentPool& pool_;
  const ControlSpace& space_;
  Origin origin_;
  std::vector<double> rest_, moves_;  // s, of each clip
  bool has_others_ = false;
};

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
  for (const Origin origin : {Origin::captured, Origin::mirrored}) {
    const Acts acts(pool, space, origin);
    const auto of_act = [&](const Fragment& f) { return acts.holds(f); };
    pool.fragments.erase(std::remove_if(pool.fragments.begin(), pool.fragments.end(), of_act), pool.fragments.end());
  }
}

}  // namespace fragmotion

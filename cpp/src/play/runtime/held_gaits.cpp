// SPDX-License-Identifier: MIT
#include "runtime/held_gaits.hpp"

#include <algorithm>
#include <limits>

#include "base/rounding.hpp"
#include "policy/answer.hpp"

namespace fragmotion {
namespace {

Control between(const Control& a, const Control& b, double share) {
  return {a.x + share * (b.x - a.x), a.y + share * (b.y - a.y), a.turn + share * (b.turn - a.turn),
          a.jump + share * (b.jump - a.jump)};
}

// Feet that come down while fragments are played, one after the other.
struct Footfalls {
  int count = 0, first = 0, last = 0;                                             // sides
  float begun = 0, latest = 0, closest = std::numeric_limits<float>::infinity();  // s
  bool alternate = true;

  void add(const EntrySteps& steps, float from, float lasts) {
    const int sooner = steps.strikes[1] < steps.strikes[0] ? 1 : 0;
    for (const int side : {sooner, 1 - sooner}) {
      if (steps.strikes[side] <= lasts + static_cast<float>(kFloatRounding)) add(side, from + steps.strikes[side]);
    }
  }

  void add(int side, float seconds) {
    if (count++ == 0) {
      first = side, begun = seconds;
    } else {
      alternate = alternate && side != last;
      closest = std::min(closest, seconds - latest);
    }
    last = side, latest = seconds;
  }

  // Whether each comes down after the other one, and later than in half the time of a step, where they do so again and
  // again. Who hops on both feet takes no steps.
  bool are_in_turns(float period) const {
    const float least = std::min(closest, begun + period - latest);
    return count > 0 && alternate && first != last && 2 * static_cast<float>(count) * least >= period;
  }
};

// Of one control after the other.
class GaitSearch {
 public:
  GaitSearch(const Character& character, const TransitionCost& cost, const std::vector<int>& successors,
             const std::vector<EntrySteps>& steps)
      : character_(character), cost_(cost), successors_(successors), steps_(steps), may_play_(steps.size()) {}

  std::vector<int> find(const Control& control) {
    least_ = std::numeric_limits<float>::infinity();
    count_ = 0;
    const bool is_held = character_.space.asks_to_go(control) && !control.jumps();
    const int fragments = is_held ? static_cast<int>(may_play_.size()) : 0;
    for (int f = 0; f < fragments; ++f) {
      const Control& evident = character_.pool.fragments[f].evident;
      may_play_[f] = goes_along(evident.x, evident.y, control) && cost_.may_go_on(f, control) ? 1 : 0;
    }
    for (int f = 0; f < fragments; ++f) look(f, control);
    std::vector<int> gait(count_);
    for (int& f : gait) f = begins_, begins_ = successors_[f];
    return gait;
  }

 private:
  // At those that begin with a fragment.
  void look(int first, const Control& control) {
    int count = 0;
    Control mean;
    double seconds = 0;
    for (int f = first; f >= 0 && may_play_[f] != 0 && count < kLanes; f = successors_[f]) {
      const Fragment& fragment = character_.pool.fragments[f];
      const double lasts = character_.pool.seconds(fragment);
      ++count;
      mean = between(mean, fragment.evident, lasts / (seconds += lasts));
      const float performing = cost_.of_performing(mean, first, control);
      if (successors_[f] < 0 || performing >= least_) continue;
      const float whole = performing + cost_.of_closing(successors_[f], first, seconds);
      if (whole < least_ && steps_in_turns(first, count)) least_ = whole, begins_ = first, count_ = count;
    }
  }

  bool steps_in_turns(int first, int count) const {
    Footfalls falls;
    double seconds = 0;
    for (int f = first; count-- > 0; f = successors_[f]) {
      const double lasts = character_.pool.seconds(character_.pool.fragments[f]);
      falls.add(steps_[f], static_cast<float>(seconds), static_cast<float>(lasts));
      seconds += lasts;
    }
    return falls.are_in_turns(static_cast<float>(seconds));
  }

  const Character& character_;
  const TransitionCost& cost_;
  const std::vector<int>& successors_;
  const std::vector<EntrySteps>& steps_;
  std::vector<char> may_play_;
  float least_ = 0;             // that a gait costs so far,
  int begins_ = 0, count_ = 0;  // with which fragment it begins, and how many it has
};

}  // namespace

[[gnu::cold]] std::vector<std::vector<int>> held_gaits(const Character& character, const TransitionCost& cost,
                                                       const std::vector<int>& successors,
                                                       const std::vector<EntrySteps>& steps) {
  GaitSearch search(character, cost, successors, steps);
  std::vector<std::vector<int>> gaits(character.space.size());
  for (std::size_t control = 0; control < gaits.size(); ++control)
    gaits[control] = search.find(character.space.point(static_cast<int>(control)));
  return gaits;
}

}  // namespace fragmotion

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

// A cycle that begins with a fragment and has so many, what it costs, and what of that how it performs.
struct Cycle {
  float cost;
  int first = 0, count = 0;
  float performing = 0;
};

// Of one control after the other.
class GaitSearch {
 public:
  GaitSearch(const Character& character, const TransitionCost& cost, const std::vector<int>& successors,
             const std::vector<EntrySteps>& steps, float variety)
      : character_(character),
        cost_(cost),
        successors_(successors),
        steps_(steps),
        variety_(variety),
        may_play_(steps.size()) {}

  std::vector<int> find(const Control& control) {
    const bool is_held = character_.space.asks_to_go(control) && !control.jumps();
    const int fragments = is_held ? static_cast<int>(may_play_.size()) : 0;
    for (int f = 0; f < fragments; ++f) {
      const Control& evident = character_.pool.fragments[f].evident;
      may_play_[f] = goes_along(evident.x, evident.y, control) && cost_.may_go_on(f, control) ? 1 : 0;
    }
    Cycle best{std::numeric_limits<float>::infinity()};
    for (int f = 0; f < fragments; ++f) {
      if (may_play_[f] == 0) continue;
      const Cycle found = least(f, control, best.cost);
      if (found.count > 0) best = found;
    }
    std::vector<int> gait;
    const Fragment& begins = character_.pool.fragments[best.first];
    const bool is_captured = best.count > 0 && !is_made(begins.origin);
    for (int f = best.first; static_cast<int>(gait.size()) < (is_captured ? 1 : best.count); f = successors_[f])
      gait.push_back(f);
    for (int f = 0; is_captured && f < fragments; ++f) {
      if (f == best.first || character_.pool.fragments[f].clip != begins.clip) continue;
      const Cycle found = least(f, control, best.cost + variety_);
      if (found.count > 0 && found.performing <= best.cost && joins(best, f)) gait.push_back(f);
    }
    return gait;
  }

 private:
  // Of those that begin with a fragment and cost less than `most`; of no fragments where there is none.
  Cycle least(int first, const Control& control, float most) const {
    Cycle best{most};
    int count = 0;
    Control mean;
    double seconds = 0;
    for (int f = first; f >= 0 && may_play_[f] != 0 && count < kLanes; f = successors_[f]) {
      const Fragment& fragment = character_.pool.fragments[f];
      const double lasts = character_.pool.seconds(fragment);
      ++count;
      mean = between(mean, fragment.evident, lasts / (seconds += lasts));
      const float performing = cost_.of_performing(mean, first, control);
      if (successors_[f] < 0 || performing >= best.cost) continue;
      const float whole = performing + cost_.of_closing(successors_[f], first, seconds);
      if (whole < best.cost && steps_in_turns(first, count)) best = {whole, first, count, performing};
    }
    return best;
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

  // Whether a fragment joins on to any of a cycle.
  bool joins(const Cycle& cycle, int fragment) const {
    for (int f = cycle.first, i = 0; i < cycle.count; ++i, f = successors_[f]) {
      if (cost_.of_joining(cost_.beside(f, fragment), 0) <= variety_) return true;
    }
    return false;
  }

  const Character& character_;
  const TransitionCost& cost_;
  const std::vector<int>& successors_;
  const std::vector<EntrySteps>& steps_;
  const float variety_;
  std::vector<char> may_play_;
};

}  // namespace

[[gnu::cold]] std::vector<std::vector<int>> held_gaits(const Character& character, const TransitionCost& cost,
                                                       const std::vector<int>& successors,
                                                       const std::vector<EntrySteps>& steps, float variety) {
  GaitSearch search(character, cost, successors, steps, variety);
  std::vector<std::vector<int>> gaits(character.space.size());
  for (std::size_t control = 0; control < gaits.size(); ++control)
    gaits[control] = search.find(character.space.point(static_cast<int>(control)));
  return gaits;
}

}  // namespace fragmotion

// SPDX-License-Identifier: MIT
#include "runtime/step_sequence.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/quantile.hpp"
#include "fragments/successors.hpp"

namespace fragmotion {
namespace {

constexpr double kQuick = 0.25;  // s
constexpr float kLands = 0.1F;   // s until a foot is down that a fragment begins with, and that is still in the air

// Where a cycle ends, and where it begins again; nowhere in other clips.
struct Wrap {
  int end = -1, begin = 0;
};

// Of each clip.
std::vector<Wrap> wraps(const Character& character) {
  const std::vector<Fragment>& fragments = character.pool.fragments;
  const std::vector<int> next = successors(fragments);
  std::vector<Wrap> all(character.pool.clips.size());
  for (std::size_t f = 0; f < next.size(); ++f) {
    if (next[f] < 0 || fragments[next[f]].first_played() == fragments[f].last_played()) continue;
    all[fragments[f].clip] = {fragments[f].last_played(), fragments[next[f]].first_played()};
  }
  return all;
}

float until_strike(const std::vector<bool>& stands, int first, const Wrap& wrap, double rate) {
  const bool wraps = wrap.end >= 0 && !stands.empty();
  const int cycle = wrap.end - wrap.begin, last = wraps ? first + cycle : static_cast<int>(stands.size()) - 1;
  for (int f = first + 1; f <= last; ++f) {
    const int at = wraps && f > wrap.end ? f - cycle : f;
    if (stands[at] && !stands[at - 1]) return static_cast<float>((f - first) / rate);
  }
  return std::numeric_limits<float>::infinity();
}

}  // namespace

void StepSequence::advance(const std::array<bool, 2>& now, double seconds) {
  since += seconds;
  for (int side = 0; side < 2; ++side) {
    if (now[side] && !stands[side]) last = side, since = 0;
  }
  stands = now;
}

std::vector<EntrySteps> entry_steps(const Character& character) {
  std::vector<EntrySteps> all;
  const std::vector<Wrap> wraps = fragmotion::wraps(character);
  for (const Fragment& f : character.pool.fragments) {
    const Contacts& contacts = character.contacts[f.clip];
    EntrySteps entry{standing_feet(contacts, f.first_played()), {}};
    for (int side = 0; side < 2; ++side) {
      entry.strikes[side] =
          until_strike(contacts.feet[side], f.first_played(), wraps[f.clip], character.pool.clips[f.clip].rate);
    }
    all.push_back(entry);
  }
  return all;
}

std::vector<double> step_seconds(const Character& character) {
  std::vector<double> all;
  std::vector<std::vector<int>> strikes;
  for (const Contacts& contacts : character.contacts) strikes.push_back(foot_strikes(contacts));
  for (const Fragment& f : character.pool.fragments) {
    const double rate = character.pool.clips[f.clip].rate, reach = kLongestStep * rate;
    std::vector<double> times;
    for (std::size_t i = 1; i < strikes[f.clip].size(); ++i) {
      const int from = strikes[f.clip][i - 1], to = strikes[f.clip][i];
      if (to > f.begin - reach && from < f.end + reach) times.push_back((to - from) / rate);
    }
    all.push_back(times.empty() ? kLongestStep : std::min(kLongestStep, median(times)));
  }
  return all;
}

std::array<bool, 2> standing_feet(const Contacts& contacts, std::size_t frame) {
  return {contacts.stands(0, frame), contacts.stands(1, frame)};
}

int steps_out_of_turn(const StepSequence& steps, const EntrySteps& entry) {
  if (steps.last < 0) return 0;
  std::array<float, 2> strikes = entry.strikes;
  for (int side = 0; side < 2; ++side) {
    if (entry.stands[side] && !steps.stands[side]) strikes[side] = kLands;
  }
  const float same = strikes[steps.last], other = strikes[1 - steps.last];
  const bool first_is_wrong = same < other || steps.since + other < kQuick;
  return int{first_is_wrong} + int{std::abs(same - other) < kQuick};
}

}  // namespace fragmotion

// SPDX-License-Identifier: MIT
#include "runtime/step_sequence.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/quantile.hpp"
#include "fragments/entry_poses.hpp"

namespace fragmotion {
namespace {

constexpr double kQuick = 0.25;  // s

// Where a cycle ends, and where it begins again; nowhere in other clips.
struct Wrap {
  int end = -1, begin = 0;
};

// The frames in which a foot comes down.
[[gnu::cold]] std::vector<int> strikes(const std::vector<bool>& stands) {
  std::vector<int> frames;
  bool stood = true;
  int frame = 0;
  for (const bool now : stands) {
    if (now && !stood) frames.push_back(frame);
    stood = now;
    ++frame;
  }
  return frames;
}

// Of each clip.
std::vector<Wrap> wraps(const Character& character, const std::vector<int>& next) {
  const std::vector<Fragment>& fragments = character.pool.fragments;
  std::vector<Wrap> all(character.pool.clips.size());
  for (std::size_t f = 0; f < next.size(); ++f) {
    if (next[f] < 0 || fragments[next[f]].first_played() == fragments[f].last_played()) continue;
    all[fragments[f].clip] = {fragments[f].last_played(), fragments[next[f]].first_played()};
  }
  return all;
}

// By the frames in which a foot comes down.
float until_strike(const std::vector<int>& strikes, int first, const Wrap& wrap, double rate) {
  const auto after = [&](int frame) { return std::upper_bound(strikes.begin(), strikes.end(), frame); };
  const auto next = after(first), again = after(wrap.begin);
  const bool wraps = wrap.end >= 0;
  if (next != strikes.end() && !(wraps && *next > wrap.end)) return static_cast<float>((*next - first) / rate);
  if (!wraps || again == strikes.end() || *again > first) return std::numeric_limits<float>::infinity();
  return static_cast<float>((*again + wrap.end - wrap.begin - first) / rate);
}

}  // namespace

void StepSequence::advance(const std::array<bool, 2>& now, double seconds) {
  since += seconds;
  for (int side = 0; side < 2; ++side) {
    if (now[side] && !stands[side]) last = side, since = 0;
  }
  stands = now;
}

[[gnu::cold]] std::vector<EntrySteps> entry_steps(const Character& character, const std::vector<int>& successors) {
  std::vector<EntrySteps> all;
  const std::vector<Wrap> wraps = fragmotion::wraps(character, successors);
  std::vector<std::array<std::vector<int>, 2>> strikes;
  for (const Contacts& contacts : character.contacts)
    strikes.push_back({fragmotion::strikes(contacts.feet[0]), fragmotion::strikes(contacts.feet[1])});
  for (const Fragment& f : character.pool.fragments) {
    const Contacts& contacts = character.contacts[f.clip];
    EntrySteps entry{standing_feet(contacts, f.first_played()), {}};
    for (int side = 0; side < 2; ++side) {
      entry.strikes[side] =
          until_strike(strikes[f.clip][side], f.first_played(), wraps[f.clip], character.pool.clips[f.clip].rate);
    }
    all.push_back(entry);
  }
  return all;
}

[[gnu::cold]] std::vector<double> step_seconds(const Character& character) {
  std::vector<double> all;
  std::vector<std::vector<int>> strikes;
  for (const Contacts& contacts : character.contacts) strikes.push_back(foot_strikes(contacts));
  for (const Fragment& f : character.pool.fragments) {
    const double rate = character.pool.clips[f.clip].rate, reach = kLongestStep * rate;
    const std::vector<int>& of_clip = strikes[f.clip];
    std::vector<double> times;
    for (auto to = std::upper_bound(of_clip.begin(), of_clip.end(), f.begin - reach); to != of_clip.end(); ++to) {
      if (to == of_clip.begin()) continue;
      if (to[-1] >= f.end + reach) break;
      times.push_back((to[0] - to[-1]) / rate);
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
    if (entry.stands[side] && !steps.stands[side]) strikes[side] = static_cast<float>(kEntry);
  }
  const float same = strikes[steps.last], other = strikes[1 - steps.last];
  const bool first_is_wrong = same < other || steps.since + other < kQuick;
  return int{first_is_wrong} + int{std::abs(same - other) < kQuick};
}

}  // namespace fragmotion

// SPDX-License-Identifier: MIT
#include "fragments/cutting.hpp"

#include <cmath>
#include <stdexcept>
#include <utility>

#include "base/ranges.hpp"

namespace fragmotion {

namespace {

constexpr double kLeastLongest = 0.1, kLongest = 10;  // s, of a fragment

// Cuts a clip between gait events, if there are any. Lengths are in frames.
struct Cutter {
  FragmentPool& pool;
  int clip, shortest, longest;
  std::vector<int> strikes, lifts, fore_strikes;

  // Adds those of the frames that lie between cuts more than `longer` apart and no nearer to them than `shortest`.
  void add_cuts(std::vector<int>& cuts, const std::vector<int>& frames, int longer) const {
    std::vector<int> all{cuts.front()};
    for (std::size_t i = 1; i < cuts.size(); ++i) {
      for (const int frame : frames) {
        if (cuts[i] - cuts[i - 1] <= longer) break;
        if (frame - all.back() >= shortest && cuts[i] - frame >= shortest) all.push_back(frame);
      }
      all.push_back(cuts[i]);
    }
    cuts = std::move(all);
  }

  // Divides frames begin .. end, between which there is no cut.
  void divide(int begin, int end) const {
    const int length = end - begin;
    if (length < shortest) return;
    int parts = (length + longest - 1) / longest, whole = length;
    if (length / parts < shortest) whole = --parts * longest;  // the rest is dropped
    for (int part = 0; part < parts; ++part) {
      Fragment fragment;
      fragment.clip = clip;
      fragment.begin = begin + whole * part / parts;
      fragment.end = begin + whole * (part + 1) / parts;
      pool.fragments.push_back(fragment);
    }
  }

  // Cuts frames begin .. end.
  void cut(int begin, int end) const {
    std::vector<int> cuts{begin, end};
    add_cuts(cuts, strikes, shortest);
    add_cuts(cuts, lifts, longest);
    add_cuts(cuts, fore_strikes, longest);
    for (std::size_t i = 1; i < cuts.size(); ++i) divide(cuts[i - 1], cuts[i]);
  }
};

}  // namespace

void check(const CutOptions& options) {
  require_range("the shortest fragment (s)", options.shortest, kShortestFragment, kLongest);
  require_range("the longest fragment (s)", options.longest, kLeastLongest, kLongest);
}

void cut_fragments(FragmentPool& pool, int clip, const Contacts& contacts, const std::vector<int>& seams,
                   const CutOptions& options) {
  check(options);
  const Clip& source = pool.clips[clip];
  const int shortest = std::max(1, static_cast<int>(std::ceil(options.shortest * source.rate - 1e-6)));
  const int longest = static_cast<int>(std::floor(options.longest * source.rate + 1e-6));
  if (longest < shortest) {
    throw std::invalid_argument("a fragment of " + std::to_string(options.shortest) + " to " +
                                std::to_string(options.longest) + " s holds no whole frame of clip \"" + source.name +
                                "\" at " + std::to_string(source.rate) +
                                " frames a second: leave it out, or tell its true rate");
  }
  Cutter cutter{pool, clip, shortest, longest, {}, {}, {}};
  if (options.at_gait_events) {
    cutter.strikes = foot_strikes(contacts);
    cutter.lifts = foot_lifts(contacts);
    cutter.fore_strikes = fore_foot_strikes(contacts);
  }
  int begin = 0;
  for (const int found : seams) {
    cutter.cut(begin, found - 1);
    begin = found;
  }
  cutter.cut(begin, source.frames - 1);
}

}  // namespace fragmotion

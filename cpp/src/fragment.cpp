// SPDX-License-Identifier: MIT
#include "fragmotion/fragment.hpp"

#include <cmath>
#include <stdexcept>
#include <utility>

#include "fragmotion/tears.hpp"

namespace fragmotion {

const char* origin_name(Origin origin) {
  static constexpr const char* kNames[] = {"captured", "mirrored", "interpolated", "transformed"};
  return kNames[static_cast<int>(origin)];
}

namespace {

// Adds those of the frames that lie between cuts more than `longer` apart and no nearer to them than `shortest`.
void add_cuts(std::vector<int>& cuts, const std::vector<int>& frames, int shortest, int longer) {
  std::vector<int> all{cuts.front()};
  for (std::size_t i = 1; i < cuts.size(); ++i) {
    if (cuts[i] - cuts[i - 1] > longer) {
      for (const int frame : frames) {
        if (frame - all.back() >= shortest && cuts[i] - frame >= shortest) all.push_back(frame);
      }
    }
    all.push_back(cuts[i]);
  }
  cuts = std::move(all);
}

// Cuts frames begin .. end of a clip.
void cut_part(FragmentPool& pool, int clip, int begin, int end, const Contacts& contacts, int shortest, int longest,
              bool at_gait_events) {
  std::vector<int> cuts{begin, end};
  if (at_gait_events) {
    add_cuts(cuts, foot_strikes(contacts), shortest, shortest);
    add_cuts(cuts, foot_lifts(contacts), shortest, longest);
  }
  for (std::size_t i = 1; i < cuts.size(); ++i) {
    const int length = cuts[i] - cuts[i - 1];
    if (length < shortest) continue;
    int parts = (length + longest - 1) / longest, whole = length;
    if (length / parts < shortest) whole = --parts * longest;  // the rest is dropped
    for (int part = 0; part < parts; ++part) {
      Fragment fragment;
      fragment.clip = clip;
      fragment.begin = cuts[i - 1] + whole * part / parts;
      fragment.end = cuts[i - 1] + whole * (part + 1) / parts;
      pool.fragments.push_back(fragment);
    }
  }
}

}  // namespace

void cut_fragments(FragmentPool& pool, int clip, const Contacts& contacts, const CutOptions& options) {
  const Clip& source = pool.clips[clip];
  const int shortest = std::max(1, static_cast<int>(std::ceil(options.shortest * source.rate - 1e-6)));
  const int longest = static_cast<int>(std::floor(options.longest * source.rate + 1e-6));
  if (longest < shortest) {
    throw std::invalid_argument("a fragment of " + std::to_string(options.shortest) + " to " +
                                std::to_string(options.longest) + " s holds no whole frame of clip \"" + source.name +
                                "\" at " + std::to_string(source.rate) + " frames a second");
  }
  int begin = 0;
  for (const int tear : tears(pool.skeleton, source)) {
    cut_part(pool, clip, begin, tear - 1, contacts, shortest, longest, options.at_gait_events);
    begin = tear;
  }
  cut_part(pool, clip, begin, source.frames - 1, contacts, shortest, longest, options.at_gait_events);
}

}  // namespace fragmotion

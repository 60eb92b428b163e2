// SPDX-License-Identifier: MIT
#include "fragmotion/fragment.hpp"

#include <cmath>
#include <stdexcept>

namespace fragmotion {

const char* origin_name(Origin origin) {
  static constexpr const char* kNames[] = {"captured", "mirrored", "interpolated", "transformed"};
  return kNames[static_cast<int>(origin)];
}

void cut_fragments(FragmentPool& pool, int clip, const Contacts& contacts, const CutOptions& options) {
  const Clip& source = pool.clips[clip];
  const int shortest = std::max(1, static_cast<int>(std::ceil(options.shortest * source.rate - 1e-6)));
  const int longest = static_cast<int>(std::floor(options.longest * source.rate + 1e-6));
  if (longest < shortest) {
    throw std::invalid_argument("a fragment of " + std::to_string(options.shortest) + " to " +
                                std::to_string(options.longest) + " s holds no whole frame of clip \"" + source.name +
                                "\" at " + std::to_string(source.rate) + " frames a second");
  }
  std::vector<int> cuts{0};
  if (options.at_gait_events) {
    for (const int strike : foot_strikes(contacts)) {
      if (strike - cuts.back() >= shortest && source.frames - 1 - strike >= shortest) cuts.push_back(strike);
    }
  }
  cuts.push_back(source.frames - 1);
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

}  // namespace fragmotion

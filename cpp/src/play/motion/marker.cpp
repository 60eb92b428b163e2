// SPDX-License-Identifier: MIT
#include "motion/marker.hpp"

#include <stdexcept>

namespace fragmotion {

void check_markers(const std::vector<Marker>& markers, int frames) {
  double before = 0;
  for (const Marker& marker : markers) {
    if (marker.name.empty()) throw std::invalid_argument("a marker has no name");
    if (!(marker.frame >= before && marker.frame <= frames - 1)) {
      throw std::invalid_argument("marker '" + marker.name + "' lies outside of the take, or before the one before it");
    }
    before = marker.frame;
  }
}

std::vector<Marker> markers_in_rounds(const std::vector<Marker>& markers, int begin, int length, int frames) {
  std::vector<Marker> repeated;
  for (int round = 0; round < frames; round += length) {
    for (const Marker& marker : markers) {
      const double at = marker.frame - begin;
      if (at >= 0 && at < length && round + at <= frames - 1) repeated.push_back({marker.name, round + at});
    }
  }
  return repeated;
}

}  // namespace fragmotion

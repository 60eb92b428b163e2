// SPDX-License-Identifier: MIT
#include "evaluate/jumps.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/quantile.hpp"
#include "evaluate/tracks.hpp"
#include "fragments/evident.hpp"

namespace fragmotion {
namespace {

constexpr double kShortest = 0.05;  // s

double median_height(const std::vector<BodyTrack>& tracks, std::vector<Vector3> BodyTrack::*path) {
  std::vector<double> heights;
  for (const BodyTrack& track : tracks) {
    for (const Vector3& place : track.*path) heights.push_back(place.z());
  }
  return heights.empty() ? 0 : median(std::move(heights));
}

bool in_the_air(const BodyTrack& track, int f) {
  for (int side = 0; side < track.feet.count(); ++side) {
    const FootPath& foot = track.feet[side];
    const FootHeights& floor = track.floors[side];
    if (foot.ball[f].z() - floor.ball < kContactHeight || foot.heel[f].z() - floor.heel < kContactHeight) return false;
  }
  return true;
}

double dip(const BodyTrack& track, int first, int last, double usual) {
  if (first < 0 || last >= track.frames()) return NAN;
  double deepest = 0;
  for (int f = first; f <= last; ++f) deepest = std::max(deepest, usual - track.hips[f].z());
  return deepest;
}

double highest(const BodyTrack& track, int first, int last) {
  double height = track.center[first].z();
  for (int f = first; f <= last; ++f) height = std::max(height, track.center[f].z());
  return height;
}

double flight_ratio(const BodyTrack& track, int take_off, int landing) {
  const double apex = highest(track, take_off, landing);
  const double rise = apex - track.center[take_off].z(), fall = apex - track.center[landing].z();
  const double ballistic = std::sqrt(2 * rise / kGravity) + std::sqrt(2 * fall / kGravity);
  return ballistic < kShortest ? NAN : (landing - take_off) / track.rate / ballistic;
}

}  // namespace

UsualHeights usual_heights(const std::vector<BodyTrack>& tracks) {
  return {median_height(tracks, &BodyTrack::center), median_height(tracks, &BodyTrack::hips)};
}

std::vector<Jump> find_jumps(const BodyTrack& track, const UsualHeights& usual) {
  std::vector<Jump> jumps;
  if (!track.has_feet()) return jumps;
  const int around = track.frames_in(kAroundJump);
  for (int f = 1; f < track.frames(); ++f) {
    if (!in_the_air(track, f)) continue;
    const int take_off = f - 1;
    while (f < track.frames() && in_the_air(track, f)) ++f;
    const bool began_before = take_off == 0 && in_the_air(track, 0);
    if (f == track.frames() || began_before || highest(track, take_off, f) < usual.center + kJumpRise) continue;
    jumps.push_back({take_off, f, dip(track, take_off - around, take_off, usual.hips),
                     dip(track, f, f + around, usual.hips), flight_ratio(track, take_off, f)});
  }
  return jumps;
}

}  // namespace fragmotion

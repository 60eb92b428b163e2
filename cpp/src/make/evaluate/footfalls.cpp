// SPDX-License-Identifier: MIT
#include "evaluate/footfalls.hpp"

#include <algorithm>

#include "motion/contacts.hpp"

namespace fragmotion {
namespace {

constexpr double kBeside = 0.25;  // s to each side
constexpr double kQuick = 0.2;    // s

struct Footfall {
  int frame = 0, side = 0;
};

std::vector<Footfall> footfalls(const BodyTrack& track) {
  std::vector<Footfall> found;
  for (int f = 1; f < track.frames(); ++f) {
    for (int side = 0; side < 2; ++side) {
      if (track.stands[side][f] && !track.stands[side][f - 1]) found.push_back({f, side});
    }
  }
  return found;
}

// Along the ground, m/s.
double speed(const BodyTrack& track, int f) {
  const int half = track.frames_in(kBeside), first = std::max(0, f - half),
            last = std::min(track.frames() - 1, f + half);
  const double middle = 0.5 * (first + last);
  Vector2 sum = Vector2::Zero();
  double square = 0;
  for (int i = first; i <= last; ++i) {
    sum += (i - middle) * track.hips[i].head<2>();
    square += (i - middle) * (i - middle);
  }
  return (sum / square).norm() * track.rate;
}

bool goes(const BodyTrack& track, int first, int last) {
  for (int f = first; f <= last; ++f) {
    if (!(speed(track, f) > kWalking)) return false;
  }
  return true;
}

}  // namespace

void Footfalls::add(const Footfalls& other) {
  count += other.count;
  same_foot += other.same_foot;
  quick += other.quick;
}

Footfalls count_footfalls(const BodyTrack& track) {
  Footfalls counted;
  if (!track.has_feet()) return counted;
  const std::vector<Footfall> all = footfalls(track);
  for (std::size_t i = 1; i < all.size(); ++i) {
    const Footfall &before = all[i - 1], &now = all[i];
    if (!goes(track, before.frame, now.frame)) continue;
    ++counted.count;
    if (now.side == before.side) ++counted.same_foot;
    if (now.side != before.side && now.frame - before.frame < kQuick * track.rate) ++counted.quick;
  }
  return counted;
}

}  // namespace fragmotion

// SPDX-License-Identifier: MIT
#include "evaluate/dragging.hpp"

#include <algorithm>
#include <utility>

namespace fragmotion {
namespace {

// Of a foot at a frame that is not the first.
FootClearance::Moment moment(const BodyTrack& track, int side, int f) {
  const std::vector<Vector3>& ball = track.feet[side].ball;
  return {(ball[f] - ball[f - 1]).head<2>().norm() * track.rate, ball[f].z() - track.floors[side].ball};
}

}  // namespace

void Dragging::add(const Dragging& other) {
  way += other.way;
  dragged += other.dragged;
}

FootClearance clearance_of(const std::vector<BodyTrack>& takes) {
  std::vector<FootClearance::Moment> moments;
  for (const BodyTrack& take : takes) {
    for (int side = 0; side < take.feet.count(); ++side) {
      for (int f = 1; f < take.frames(); ++f) moments.push_back(moment(take, side, f));
    }
  }
  return FootClearance(std::move(moments));
}

Dragging dragging(const BodyTrack& track, const FootClearance& takes, int first) {
  Dragging found;
  for (int side = 0; side < track.feet.count(); ++side) {
    for (int f = std::max(1, first); f < track.frames(); ++f) {
      const auto [speed, height] = moment(track, side, f);
      const double way = speed / track.rate;
      found.add({way, height < takes.at(speed) ? way : 0});
    }
  }
  return found;
}

}  // namespace fragmotion

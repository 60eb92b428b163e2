// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "evaluate/body_track.hpp"
#include "evaluate/performance.hpp"
#include "fragments/fragment.hpp"

namespace fragmotion {

/// The clips of a pool that hold captured fragments, at 60 frames a second; they have no headings.
std::vector<Clip> captured_takes(const PackedPool& pool);

/// What takes do, on the floors that most of them stand on, m of a 1.8 m character; 0 for bodies without feet.
struct TakeTracks {
  std::vector<BodyTrack> tracks;
  Floors floors;
};
TakeTracks tracks_of(const Skeleton& skeleton, const std::vector<Clip>& takes);

/// What was played, as a clip without headings.
Clip clip_of(const Performance& performance);

}  // namespace fragmotion

// SPDX-License-Identifier: MIT
#include "doctor/tracks.hpp"

#include <algorithm>
#include <stdexcept>

#include "doctor/patient.hpp"
#include "motion/discontinuities.hpp"

namespace fragmotion {
namespace {

constexpr int kPiece = 4096;  // frames

template <typename T>
void append(const std::vector<T>& from, int first, std::vector<T>& to) {
  to.insert(to.end(), from.begin() + first, from.end());
}

// A piece of which the first frames were in the one before.
void add_piece(const Kinematics& kinematics, const Clip& clip, int begin, int known, Tracks& tracks) {
  for (int f = known; f < clip.frames; ++f)
    tracks.hips.push_back(load_vector(&clip.root_positions[std::size_t{3} * f]));
  const FootPaths paths = foot_paths(kinematics, clip);
  for (int side = 0; side < kMostLegs && !paths[side].ball.empty(); ++side) {
    append(paths[side].ball, known, tracks.feet[side].ball);
    append(paths[side].heel, known, tracks.feet[side].heel);
  }
  for (const int f : discontinuities(kinematics.skeleton(), clip)) {
    if (f >= known) tracks.torn.push_back(begin + f);
  }
}

}  // namespace

// A piece begins with the last frame of the one before, and has two frames at least.
std::optional<Tracks> tracks_of(const Patient& patient) {
  try {
    check_stature(patient.skeleton());
    const Kinematics kinematics(patient.skeleton());
    Tracks tracks;
    int known = 0;
    do {
      const int begin = std::max(0, known - 1), end = std::min(begin + kPiece, patient.frames());
      add_piece(kinematics, clip_from_take(patient.skeleton(), patient.part({begin, end - 1})), begin, known - begin,
                tracks);
      known = end;
    } while (known < patient.frames());
    return tracks;
  } catch (const std::invalid_argument&) {
    return std::nullopt;
  }
}

}  // namespace fragmotion

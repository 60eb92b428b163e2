// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "motion/clip.hpp"

namespace fragmotion {

/// Frames `first` .. `last` of a clip.
struct Span {
  int first = 0, last = 0;
};

/// What a character learns from of a clip on the spot that holds several motions one after the other, as files for
/// games have them on one timeline: its gaits and its stands, in order; nothing where it holds no gait or one motion
/// alone. A gait is a shortest part that is a cycle (cycle_of()) and goes as feet that stand tell (find_feet_way()),
/// never slower than half as fast as on the mean or faster than twice; a stand are frames for as long as the shortest
/// gait's cycle or longer in which no foot moves. What is between, where an animator's curves lead from one motion to
/// the next, a fall or a roll, is neither.
std::vector<Span> motions_within(const Kinematics& kinematics, const Clip& clip);

}  // namespace fragmotion

// SPDX-License-Identifier: MIT
#pragma once

#include "bake/motion.hpp"

namespace fragmotion {

/// The first motion's frames 0 .. `end` to the bit, and then the second's after frame `beginning`, which is taken for
/// the moment of `end`: carried to where the character is and faces then, at the velocity that it has, and stitched
/// (inertialization.hpp). Throws std::invalid_argument as check_motion(), unless the rates are the same, and on frames
/// that do not exist.
Motion join(const Skeleton& skeleton, const Motion& first, int end, const Motion& second, int beginning);

/// Where two motions are best joined.
struct Seam {
  int end = 0;          ///< The frame that is the first's last.
  int beginning = 0;    ///< The frame of the second that is taken for the same moment.
  double distance = 0;  ///< Mean between the bones' tips then, seen from the character frame, m of a 1.8 m character.
};

/// Of all pairs of these frames the one whose poses, and poses a thirtieth of a second later, are nearest; the first of
/// several. Throws std::invalid_argument as check_motion(), and on frames that there are none of or that do not exist.
Seam find_seam(const Skeleton& skeleton, const Motion& first, const std::vector<int>& ends, const Motion& second,
               const std::vector<int>& beginnings);

/// The motion with its character frame at frame `end` moved to `target`: frames 0 .. `begin` are to the bit as they
/// were, what follows `end` is moved with it as a whole, and in between place and heading go there smoothly. Throws
/// std::invalid_argument as check_motion(), unless 0 <= begin < end < frames, and unless `target` is within 1e9.
Motion spread(const Skeleton& skeleton, const Motion& motion, int begin, int end, const CharacterFrame& target);

}  // namespace fragmotion

// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string>
#include <vector>

#include "base/progress.hpp"
#include "motion/take.hpp"

namespace fragmotion {

enum class Severity { kInfo, kWarning, kError };

/// Something about a take that a person should know before anything is made of it.
struct Finding {
  std::string code;  ///< One of finding_codes().
  Severity severity = Severity::kInfo;
  int begin = 0, end = 0;  ///< The frames of the take, from 0, the last included.
  std::string text;        ///< What is wrong, where and what to do.
  bool mendable =
      false;          ///< Whether mend() (mend.hpp) can put it right; a duplicate is mended by leaving the take out.
  bool safe = false;  ///< Whether it may be mended unasked: what is mended is sure, and nothing is invented.
  int other = -1;     ///< Of a duplicate: the take that has the same motion.
};

/// What a take is, and what is wrong with it. Directions are "+X" to "-Z" in the take's own axes, "" where they cannot
/// be told.
struct Examination {
  double stature = 0;  ///< m, in the unit that the body tells; 0 where the bones have no length.
  double scale = 1;    ///< What the take's lengths are to be multiplied by to be metres.
  std::string up;      ///< From the feet to the head as the body moves.
  std::string facing;  ///< Where a body that stands at rest looks.
  double rate = 0;     ///< Frames a second.
  bool root_motion = true;
  std::string rest_pose;                     ///< "T", "A", "down", "other" (or no pose of a body), or "" without arms.
  std::map<std::string, std::string> roles;  ///< As named_bones() (role_map.hpp).
  std::vector<Finding> findings;
};

/// Every code that a finding can have, in the order in which they are looked for and mended:
/// missing (not a number), unit, up, mirrored, facing, flip (a bone turned over for a moment), spike (out of line for a
/// moment), doubled (each frame stands several times), frozen, calibration, dropped (frames left out), jump (no body
/// gets from one frame to the next), ground, slope, axes (of the root's way), drift (of feet that stand), in_place,
/// noise, rate, size, body, short, duplicate.
const std::vector<std::string>& finding_codes();

/// Examines takes as they were read, each by itself and for motion that is in several of them; `threads` as
/// thread_count(). Numbers may be missing (not finite). Beside a take it holds some 150 bytes a frame, and what is
/// mended on the way.
std::vector<Examination> examine(const std::vector<const Take*>& takes, int threads = 0, const Progress& progress = {});
std::vector<Examination> examine(const std::vector<Take>& takes, int threads = 0, const Progress& progress = {});

/// What examine() finds of the height at which feet stand, in a take with whose other faults nothing is done.
std::vector<Finding> examine_ground(const Take& take);

}  // namespace fragmotion

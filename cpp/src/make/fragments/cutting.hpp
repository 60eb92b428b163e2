// SPDX-License-Identifier: MIT
#pragma once

#include "fragments/fragment.hpp"
#include "motion/contacts.hpp"

namespace fragmotion {

struct CutOptions {
  bool at_gait_events = true;  ///< At foot strikes, where the skeleton has feet; else by windows.
  double shortest = 0.1;       ///< s, kShortestFragment .. 10
  double longest = 0.5;        ///< s, 0.1 .. 10
};

/// Throws std::invalid_argument naming the limit that is out of its range.
void check(const CutOptions& options);

/// Cuts clip `clip` of the pool into fragments (Sec. 4: 100 to 500 ms) and appends them. A step
/// that is longer than `longest` is cut where a foot leaves the ground, too, as in the middle of a swing the one foot
/// is where the other is in the next. What is still longer is divided into equal parts, or into parts of `longest`
/// without the rest where equal ones would be shorter than `shortest`; cuts nearer than `shortest` are dropped. No
/// fragment goes over one of `seams`, its discontinuities(). Throws std::invalid_argument on a limit out of its range,
/// and on limits with no whole number of frames between them for this clip's rate.
void cut_fragments(FragmentPool& pool, int clip, const Contacts& contacts, const std::vector<int>& seams,
                   const CutOptions& options);

}  // namespace fragmotion

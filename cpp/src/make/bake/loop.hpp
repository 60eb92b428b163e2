// SPDX-License-Identifier: MIT
#pragma once

#include "bake/motion.hpp"

namespace fragmotion {

/// The motion with its last `count` frames eased so that it ends as it began: seen from the character frame, the last
/// pose is the first one, and the one before leads up to it at the first's velocity; the path's last step is its first.
/// `count` is brought within 2 and the motion's steps; fewer than three frames stay as they are. `hips` is a number of
/// a bone.
Motion looped(const Motion& motion, int hips, int count);

}  // namespace fragmotion

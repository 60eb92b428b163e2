// SPDX-License-Identifier: MIT
#pragma once

#include "motion/clip.hpp"

namespace fragmotion {

/// m of a 1.8 m character: a body that rises less neither bounces nor flies.
constexpr double kLeastBounce = 0.02;

/// The frames in which a body goes up and down as in every step of a gait, however high: [frames], all false where the
/// skeleton has no feet. `center`: the path of its centre of mass. In a gait the feet change places from each lowest
/// moment to the next, or, where legs are rigid and pass each other there, from each highest one, but not those of
/// four-legged bodies, which may gallop; and each step rises as high as the one beside it (the spring-mass model of
/// bouncing gaits: Cavagna, Heglund, Taylor 1977), or in a gallop, which may fly twice in a stride, gathered and
/// stretched (Hildebrand 1959), as the one after that. A jump lands as it took off, or rises higher than the steps
/// beside it.
std::vector<bool> gait_bounces(const Kinematics& kinematics, const Clip& clip, const std::vector<Vector3>& center);

}  // namespace fragmotion

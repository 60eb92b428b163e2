// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "motion/clip.hpp"

namespace fragmotion {

/// Where a body goes that is shown on the spot, as its feet tell.
struct FeetWay {
  std::vector<Vector2> velocities;  ///< [frames - 1] m/s, from each frame to the next, in the clip's axes
  double turn = 0;                  ///< rad/s, left is positive; 0 of a body that is seen to turn
  Vector2 mean = Vector2::Zero();   ///< m/s: the mean velocity, as the body sees it: right, forward
};

/// The way of a clip on the spot; nothing where the hips travel or the feet do not tread, and where the skeleton has
/// not two feet. A foot that stands is still, so the body goes as the sole on the ground goes back; of what is low
/// enough and goes back level the fastest tells, as nothing of a foot goes back over the ground. What rises or falls
/// is a foot that lands or leaves, as is what would ask for more grip than the body's weight gives (a change of
/// velocity of 9.81 m/s^2). In a flight the velocity goes from what it was to what it will be. Of a cycle (cycle_of())
/// the ends are each other's neighbours. Where rigid legs pass each other, as low the one as the other, the body goes
/// where it faces, in each step as far as they open.
std::optional<FeetWay> find_feet_way(const Kinematics& kinematics, const Clip& clip);

/// [frames] where the way takes the clip's place: what was at x and y is at frame.position + R(frame.heading) (x, y).
/// All is `faster` times as fast.
std::vector<CharacterFrame> placements(const FeetWay& way, const Clip& clip, double faster = 1);

/// The clip on its way.
Clip led(const Kinematics& kinematics, Clip clip, const FeetWay& way, double faster = 1);

}  // namespace fragmotion

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
  bool by_legs = false;             ///< How far legs with feet open tells it, for none of what stands does.
};

/// Whether the body is seen to turn: its feet may then turn with it as they stand. In a cycle the hips' own
/// headings at its ends tell it, which are at the same place of their sway; smoothed ones are not, where it is short.
bool turns(const Kinematics& kinematics, const Clip& clip);

/// Where the clip faces on the mean, rad.
double mean_facing(const Clip& clip);

/// Whether in most frames of a clip the hips are about where they are in the others: at the end a fall may lead away.
bool stays_mostly(const Kinematics& kinematics, const Clip& clip);

/// The way of a clip on the spot; nothing where the hips travel or the feet do not tread, and where the skeleton has
/// not two feet. A foot that stands is still, so the body goes as the sole on the ground goes back: about as fast as
/// most of what is low and level does (steadiest_speed()), for drawn feet may slap the ground or drag over it, and of
/// what goes so the fastest tells, as nothing of a foot goes back over the ground. What goes slower than the grip of
/// the body's weight allows (a change of velocity of 9.81 m/s^2) is a foot that lands or leaves. In a flight the
/// velocity goes from what it was to what it will be. Of a cycle (cycle_of()) the ends are each other's neighbours.
/// Where feet go forth and back on one path the body goes where it faces; where legs pass each other, as low the one as
/// the other, in each step as far as they open. The frame rate tells nothing (Treading).
std::optional<FeetWay> find_feet_way(const Kinematics& kinematics, const Clip& clip);

/// Straight ahead at `speed` m/s, where the clip faces on the mean, whatever its feet do; nothing where the hips
/// travel.
std::optional<FeetWay> way_ahead(const Kinematics& kinematics, const Clip& clip, double speed);

/// Whether a clip whose way is not found may be a gait all the same: a cycle on the spot in which its feet, or where it
/// has none the bone that does most, go about as fast as a body does that moves.
bool may_go(const Kinematics& kinematics, const Clip& clip);

/// [frames] where the way takes the clip's place: what was at x and y is at frame.position + R(frame.heading) (x, y).
/// All is `faster` times as fast.
std::vector<CharacterFrame> placements(const FeetWay& way, const Clip& clip, double faster = 1);

/// The clip on its way; it is Clip::led.
Clip led(const Kinematics& kinematics, Clip clip, const FeetWay& way, double faster = 1);

}  // namespace fragmotion

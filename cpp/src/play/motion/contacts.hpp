// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <vector>

#include "motion/clip.hpp"

namespace fragmotion {

/// Heights of a foot's ball (the toe's head, else the foot's tip) and heel (the foot's head), m.
struct FootHeights {
  double ball = 0, heel = 0;
};

using Floors = std::array<FootHeights, kMostLegs>;  ///< Of each foot, where it stands.

/// Which feet stand on the ground in each frame of a clip.
struct Contacts {
  std::array<std::vector<bool>, kMostLegs> feet;  ///< of each foot [frames]; empty where the skeleton has it not
  Floors floors;

  bool stands(int foot, std::size_t frame) const { return frame < feet[foot].size() && feet[foot][frame]; }
  bool any_stands(std::size_t frame) const;
  /// The left and the right one.
  bool both_stand(std::size_t frame) const;
};

/// Of a path's points, that may be under its floor.
constexpr double kUnderFloor = 0.02;

/// Where a point of a foot stands: the height over which it is all but kUnderFloor of the time, so that neither a hard
/// landing nor a bad frame is taken for the floor.
double floor_of(const std::vector<Vector3>& path);

/// Where feet stand in most clips: the medians, 0 where there are none.
Floors usual_floors(const std::vector<Contacts>& contacts);

/// m/s of a character of 1.8 m: slower than this it stands,
constexpr double kMoving = 0.3;
/// and slower than this it shuffles, as between jumps and stands, and does not walk.
constexpr double kWalking = 0.5;

/// m/s of a character of 1.8 m: from where on a foot of a body that stands still does not stand; and from where on the
/// ball of a foot that rises goes away.
constexpr double kStandingSpeed = 0.5, kLeaves = 0.25;

/// A foot stands while its lower end is within 4.5 cm of its floor and nearly still: slower than kStandingSpeed plus a
/// fifth of the hips' speed (lengths of a character of 1.8 m). Gaps and contacts shorter than 0.06 s are closed, these
/// where the foot has longer ones. The floor is floor_of() ball and heel in the clip, unless one is given: a short clip
/// need not touch it.
Contacts find_contacts(const Kinematics& kinematics, const Clip& clip, const Floors* floors = nullptr);

/// The contacts for which feet are held in place (foot_lock.hpp): those of find_contacts(), each of which ends as soon
/// as the ball rises and goes away, though it is low and slow enough to stand still.
Contacts find_plants(const Kinematics& kinematics, const Clip& clip, const Floors* floors = nullptr);

/// The frames in which a foot strikes the ground, of four-legged bodies a hind one, in order: the gait events between
/// fragments.
std::vector<int> foot_strikes(const Contacts& contacts);

/// The frames in which such a foot leaves the ground, and in which a fore foot strikes it, in order.
std::vector<int> foot_lifts(const Contacts& contacts);
std::vector<int> fore_foot_strikes(const Contacts& contacts);

}  // namespace fragmotion

// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "fragments/fragment.hpp"

namespace fragmotion {

/// At which the hips go over the ground in a fragment, m/s in the character frame halfway: the way that a character
/// takes. Its evident velocity is that of the centre of mass, which in a part of a step is another.
Vector2 hips_velocity(const PackedClip& clip, const Fragment& fragment);

/// How the hips go over the ground: m/s in the character frame halfway, and rad/s.
struct Travel {
  Vector2 velocity = Vector2::Zero();
  double turn_rate = 0;
};

/// How they go over so many seconds around a frame of a clip, as far as the clip has them: over those of a step it is
/// how a body gets faster or slower and turns, without the sway and the ripple of its steps.
Travel travel_around(const PackedClip& clip, double frame, double seconds);
Vector2 hips_velocity_around(const PackedClip& clip, double frame, double seconds);

/// The mean of that over a fragment's time. It is hips_velocity() but for what is around its ends.
Vector2 mean_velocity_around(const PackedClip& clip, const Fragment& fragment, double seconds);

/// Of the hips in the first and the last tenth of a second of a fragment, m/s in the character frame: they differ much
/// where it starts, brakes or turns, though its mean be that of a steady one.
struct EndVelocities {
  Vector2 first = Vector2::Zero(), last = Vector2::Zero();
};

/// Of all fragments.
std::vector<EndVelocities> end_velocities(const PackedPool& pool);

}  // namespace fragmotion

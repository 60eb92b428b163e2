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

/// How much the velocity of the hips changes within each fragment, from its first tenth of a second to its last, m/s of
/// a 1.8 m character: much where it starts, brakes or turns, though its mean be that of a steady one.
std::vector<double> velocity_changes(const PackedPool& pool);

}  // namespace fragmotion

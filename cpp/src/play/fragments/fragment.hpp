// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "control/control.hpp"
#include "motion/packed_clip.hpp"

namespace fragmotion {

/// Where a fragment comes from: the takes, their mirror image, or synthesis (Sec. 4).
enum class Origin : std::uint8_t { captured, mirrored, interpolated, transformed };

/// Whether synthesis made it.
constexpr bool is_made(Origin origin) { return origin != Origin::captured && origin != Origin::mirrored; }

/// The name of an origin.
const char* origin_name(Origin origin);

/// One cycle of an action: the frames begin .. end of a clip, both included; frame `end` is also the first of what
/// follows in the clip. Lasts (end - begin) / rate seconds.
struct Fragment {
  int clip = 0;
  int begin = 0;
  int end = 0;
  Origin origin = Origin::captured;
  Control evident;  ///< Ev(f), see evident.hpp.
  /// Frames of the clip that are played before `begin` and after `end` as well: of a jump, the crouch and the landing
  /// (whole_jumps.hpp).
  int lead_in = 0, lead_out = 0;

  int first_played() const { return begin - lead_in; }
  int last_played() const { return end + lead_out; }
};

/// All fragments, with the clips that hold their poses.
template <typename AnyClip>
struct Pool {
  Skeleton skeleton;
  std::vector<AnyClip> clips;
  std::vector<Fragment> fragments;

  double seconds(const Fragment& fragment) const { return (fragment.end - fragment.begin) / clips[fragment.clip].rate; }
};

using FragmentPool = Pool<Clip>;

/// As a character holds them.
using PackedPool = Pool<PackedClip>;

/// s that a fragment lasts at least: a player that goes through an hour of them at once takes no second.
constexpr double kShortestFragment = 0.02;

}  // namespace fragmotion

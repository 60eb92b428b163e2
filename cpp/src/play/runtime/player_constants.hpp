// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string>

#include "feet/feet_constants.hpp"

namespace fragmotion {

/// Of a stitch (inertialization.hpp).
struct StitchConstants {
  double fades = 2.4;  ///< Time constants of the offset in PlayerOptions::stitch; (1 + 2.4) exp(-2.4) is three tenths.
  double calms = 12;   ///< 1/s: at least so fast fade speeds, which carry a pose too far in a long stitch.
};
inline constexpr StitchConstants kUsualStitch{};

/// What a body can do of a command beyond what its fragments show. The rest follows from the takes.
struct RootLimits {
  double acceleration = 4.8;  ///< m/s^2 of a 1.8 m character: of the velocity, at a responsiveness of a half.
  double stride = 0.6;        ///< Of a fragment's speed: by so much its strides are made longer or shorter at most.
  double fastest = 1.2;       ///< Of the captured tempo: at most so fast its steps follow each other.
  double settles = 0.03;      ///< s: time constant of what is added to what plays.
  double sways = 0.05;        ///< m/s of a 1.8 m character: at most so fast one sways that stands.
};

/// Of what plays next, and when (transition_cost.hpp), in metres of Dis of a body whose tip_reach() is kTunedReach.
struct TransitionWeights {
  double match = 0.9;      ///< A unit of ControlDis between what a fragment does and the control.
  double manner = 0.3;     ///< For each of: it is synthesized, captured and mirrored follow each other, and another
                           ///< take goes on, as no two are of quite one manner.
  double unsteady = 5;     ///< Each m/s by which a fragment gets faster or slower: one limps through a held control.
  double bent = 1.5;       ///< A turn rate by which a fragment turns otherwise than asked: planted feet are twisted.
  double hurried = 3;      ///< All of a step that a fragment lacks: parts of steps bring a stitch the more.
  double out_of_turn = 2;  ///< Each foot that comes down out of turn.
  double wait = 1.6;  ///< A second of each unit of ControlDis between what plays and the class that the policy tells,
                      ///< at a responsiveness of a half.
  double skip = 1;    ///< That the class which the policy tells is skipped for the one after it.
  double variety = 0.7;  ///< By so much more than the least a fragment may cost that is drawn.
};

/// Of a body that leans into its acceleration (lean.hpp).
struct LeanConstants {
  double share = 0.5;     ///< Of the angle that would balance it.
  double follows = 0.12;  ///< s: time constant of each of two filters, so that no lean begins with a jerk.
};

/// What the run time cannot derive from the character's takes nor from physics. `dev.py tune` fits these by what
/// players and viewers see; a game leaves them as they are.
struct PlayerConstants {
  StitchConstants stitch;
  RootLimits root;
  TransitionWeights transition;
  FeetConstants feet;
  LeanConstants lean;
};

/// Calls `visit(name, value)` with each of the constants.
template <typename Constants, typename Visit>
void for_each_constant(Constants& constants, const Visit& visit) {
  visit("stitch_fades", constants.stitch.fades);
  visit("stitch_calms", constants.stitch.calms);
  visit("root_acceleration", constants.root.acceleration);
  visit("root_stride", constants.root.stride);
  visit("root_fastest", constants.root.fastest);
  visit("root_settles", constants.root.settles);
  visit("root_sways", constants.root.sways);
  visit("transition_match", constants.transition.match);
  visit("transition_manner", constants.transition.manner);
  visit("transition_unsteady", constants.transition.unsteady);
  visit("transition_bent", constants.transition.bent);
  visit("transition_hurried", constants.transition.hurried);
  visit("transition_out_of_turn", constants.transition.out_of_turn);
  visit("transition_wait", constants.transition.wait);
  visit("transition_skip", constants.transition.skip);
  visit("transition_variety", constants.transition.variety);
  visit("feet_release", constants.feet.release);
  visit("feet_rests", constants.feet.rests);
  visit("feet_sinks", constants.feet.sinks);
  visit("feet_too_far", constants.feet.too_far);
  visit("feet_alone", constants.feet.alone);
  visit("feet_strained", constants.feet.strained);
  visit("feet_astray", constants.feet.astray);
  visit("feet_step", constants.feet.step);
  visit("feet_hovers", constants.feet.hovers);
  visit("feet_ahead", constants.feet.ahead);
  visit("lean_share", constants.lean.share);
  visit("lean_follows", constants.lean.follows);
}

/// The constants, but for those that `values` names. Throws std::invalid_argument on a name that there is not, and
/// unless each value is over 0 and at most a thousand.
PlayerConstants player_constants(const std::map<std::string, double>& values);

}  // namespace fragmotion

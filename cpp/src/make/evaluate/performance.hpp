// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "base/progress.hpp"
#include "control/trace.hpp"
#include "control/trace_frames.hpp"
#include "runtime/player.hpp"

namespace fragmotion {

/// What a player did, a pose a frame, and how well it followed its trace: means over time. Velocity and turn rate are
/// those of the character frame over the half second around, so that the sway of a gait is no error.
struct Performance {
  double rate = 0;  ///< Frames a second.
  int frames = 0;
  std::vector<double> root_positions;  ///< [frames, 3] m
  std::vector<double> rotations;       ///< [frames, bones, 4]
  std::vector<double> path;            ///< [frames, 3]: character frame x, y in m and heading in rad, unwrapped
  std::vector<int> styles;             ///< [frames]: Player::playing_style()
  std::vector<int> classes;            ///< [frames], of the style that plays
  std::vector<int> fragments;          ///< [frames], likewise
  std::vector<int> moves;              ///< [frames, 2]: Player::playing_moves()
  std::vector<int> entered;            ///< [frames]: fragments begun since the first frame; one may follow itself
  double quality = 0;                  ///< Eq. 2 for what plays and the control then, 0..1.
  double velocity_error = 0;           ///< |velocity - commanded|, seen from the character frame, m/s.
  double turn_error = 0;               ///< |turn rate - commanded|, rad/s.
  double jump_error = 0;  ///< Share of the time in which a jump was commanded and none played, or none and one did.
  double commanded_speed = 0;  ///< m/s
  /// How far the root gets in a second from where the trace, followed exactly, would have led it, m/s: mean over all
  /// spans of two seconds, from the place and heading at the beginning of each.
  double drift = 0;
  double drift_heading = 0;  ///< How far its heading gets from that in two seconds, rad: mean over these spans.
  /// Likewise against the trace as a body can follow it: whose velocity changes by no more than kBodyAcceleration
  /// (CommandLimit), from standing.
  double velocity_error_limited = 0;                    ///< m/s
  double drift_limited = 0, drift_heading_limited = 0;  ///< m/s; rad
};

/// A change of style that was asked for while a trace was played.
struct StyleChange {
  int control = 0;  ///< Before which of the trace's controls.
  int style = 0;
};

/// Where it was asked to look while a trace was played, as Player::look.
struct LookChange {
  int control = 0;  ///< Before which of the trace's controls.
  Look look = Look::as_captured;
  Vector3 place = Vector3::Zero();
};

/// What a hand was asked to hold or to reach for while a trace was played, as Player::reach.
struct ReachChange {
  int control = 0;  ///< Before which of the trace's controls.
  int hand = 0;
  HandAim aim;
};

/// By how much a body of 1.8 m changes its velocity, m/s^2.
constexpr double kBodyAcceleration = 5;

/// Steps a player through a trace from now: frames 0 .. round(duration * rate), each control for 1/kTraceRate s. Throws
/// std::invalid_argument on an empty trace and a rate that is not over 0 and at most 1000, and on a move that does not
/// exist, is asked for after the trace or held for less than no time; likewise on styles, looks and reaches.
Performance perform(Player& player, const Trace& trace, double rate, const Progress& progress = {},
                    const std::vector<MovePress>& moves = {}, const std::vector<StyleChange>& styles = {},
                    const std::vector<LookChange>& looks = {}, const std::vector<ReachChange>& reaches = {});
inline Performance perform(Player&& player, const Trace& trace, double rate, const Progress& progress = {},
                           const std::vector<MovePress>& moves = {}, const std::vector<StyleChange>& styles = {}) {
  return perform(player, trace, rate, progress, moves, styles);
}

/// Fills the errors, the commanded speed and the drift of a performance of a trace.
void judge(Performance& performance, const Character& character, const Trace& trace);

/// A clip that anything made under a trace, judged as a player's performance is. Where the character faces is what the
/// clip's headings say. What plays is unknown: there are no classes, fragments, quality and jump error. `entered` as in
/// Performance. Throws std::invalid_argument unless the clip has the character's bones and the frames that a player
/// would have shown at its rate.
Performance judge_clip(const Character& character, const Trace& trace, const Clip& clip, std::vector<int> entered);

/// The yardstick of Performance::quality: the greatest mean over time of Eq. 2 that a player could reach on a trace who
/// knew all of it, played at `rate`. It may play a class for any time from `shortest` seconds to the longest of its
/// fragments, so no player that ends no fragment sooner is better.
double optimal_performance(const Character& character, const Trace& trace, double rate, double shortest);

}  // namespace fragmotion

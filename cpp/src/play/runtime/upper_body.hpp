// SPDX-License-Identifier: MIT
#pragma once

#include "motion/trunk.hpp"
#include "runtime/move_track.hpp"
#include "runtime/playback.hpp"

namespace fragmotion {

/// Moves of the upper body over whatever the legs do: the spine's lowest bone is turned as in the move, seen from where
/// the character faces, and all above it moves as in the move. They are blended in and out. Allocates nothing once it
/// is made.
class UpperBody {
 public:
  /// As Playback.
  UpperBody(const Character& character, Workspace& workspace, Stitching stitching, double stitch);

  /// As Playback.
  void set_stitch(double stitch) { playback_.set_stitch(stitch); }
  void reset();
  const PassedMarkers& passed_markers() const { return playback_.passed(); }
  void forget_markers() { playback_.forget_markers(); }
  /// Begins the move that waits in the track.
  void begin();
  /// Plays on; writes over Workspace::shown.
  void advance(double seconds);
  /// Lays what plays over a pose.
  void lay(WorldPose& pose) const;
  /// How far the tips of Workspace::shown are from where the beginning of a move would have them, m of a body
  /// whose tip_reach() is kTunedReach.
  double distance_to(int move) const;

  MoveTrack track;

 private:
  friend struct PlayerState;

  bool is_ending() const;
  void lay(const WorldPose& move, double weight, WorldPose& pose) const;

  const Character* character_;
  Workspace* workspace_;
  int base_;
  std::vector<int> bones_;  // above the base
  Playback playback_;
  double weight_ = 0;  // how far it is blended in, in time
};

}  // namespace fragmotion

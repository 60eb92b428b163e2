// SPDX-License-Identifier: MIT
#pragma once

#include "direct/path_pace.hpp"
#include "skeleton/kinematics.hpp"

namespace fragmotion {

/// Where a character faces that follows a path.
enum class PathFacing {
  along,    ///< The way it goes.
  heading,  ///< FollowOptions::heading
  place     ///< FollowOptions::place
};

/// What it does at the path's end.
enum class PathEnd {
  stand,  ///< It stops there: of a closed path, after one round.
  loop,   ///< It goes round and round; an open path is closed by a straight line.
  go_on   ///< It goes straight on; round a closed path it goes on as with loop.
};

struct FollowOptions {
  double speed = 0;  ///< m/s; 0: as fast as the character walks. The path's own speeds count before it.
  /// s after the beginning at which it is to be at the path's end, whatever the speed, or the time of a round of one
  /// that loops; 0: any time
  double arrive = 0;
  PathFacing facing = PathFacing::along;
  double heading = 0;               ///< rad
  Vector2 place = Vector2::Zero();  ///< m
  PathEnd end = PathEnd::stand;
  double stop_early = 0;  ///< m by which it is told sooner to stand at the end than a body takes to
};

/// Where a character stands at the beginning of a path, facing along it.
CharacterFrame start_of(const Path& path);

/// Steers a character along a path in closed loop: from where it is, the control to give now. Deterministic; allocates
/// nothing once it is made. A character that begins away from the path goes to its beginning first.
class PathFollower {
 public:
  /// Throws std::invalid_argument on a speed that is not 0 to 1000 m/s, a time that is not 0 to a day, and a heading or
  /// place that is not finite.
  PathFollower(const ControlSpace& space, const Path& path, const FollowOptions& options = {});

  /// Begins again.
  void reset();
  /// The control for a character that is at `frame`, `seconds` after the last call: one for each frame of a game, or
  /// one each 1/kTraceRate s. Throws std::invalid_argument unless the frame is finite and `seconds` 0 to 3600.
  Control steer(const CharacterFrame& frame, double seconds);

  /// The character was put to another place: it goes on from there, at the velocity that it had.
  void moved(const CharacterFrame& to);

  const Path& path() const { return path_; }
  /// How far it has come, m; round a path that loops this goes on lap after lap.
  double way() const { return way_; }
  /// Whether it has got to the path, and the way counts.
  bool is_on_path() const { return !approaches_; }
  /// Whether it has been told to stand at the end.
  bool stands() const { return stands_; }
  /// Until it is at the path's end, s, of a character on the path.
  double seconds_left() const;
  /// The greatest speed that is asked for, m/s, or the mean of a path that has to be done in a time. A character that
  /// does not run so fast goes as fast as it runs.
  double asked_speed() const;

 private:
  friend struct PlayerState;

  struct Aim {
    Vector2 off;       // m, from where it is to its place on the path
    double left = 0;   // m to the end, infinity where it does not stand there
    double speed = 0;  // m/s now
    double soon = 0;   // s until the control shows, which holds for twice as long
  };

  void observe(const CharacterFrame& frame, double seconds);
  void follow_way(const CharacterFrame& frame, double seconds);
  void set_speed();
  bool waits() const;
  Aim aim(const CharacterFrame& frame, double seconds) const;
  Vector2 velocity(const Aim& aim) const;
  Vector2 stopped(const Vector2& velocity, const Aim& aim, double seconds);
  double angle_to_face(const CharacterFrame& frame, const Aim& aim) const;
  Vector2 direction(double way, double span) const;
  double scaled(double metres) const { return metres / space_.scale(); }

  ControlSpace space_;
  FollowOptions options_;
  Path path_;
  PathPace pace_;
  double way_ = 0, seconds_ = 0;
  double speed_ = 0;                    // m/s, where nothing limits it
  Vector2 velocity_ = Vector2::Zero();  // m/s, as it was lately
  CharacterFrame before_;
  bool observed_ = false, approaches_ = true, set_off_ = false, stands_ = false;
};

}  // namespace fragmotion

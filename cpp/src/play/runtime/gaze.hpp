// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>

#include "base/approach.hpp"
#include "control/control.hpp"
#include "motion/pose.hpp"
#include "runtime/workspace.hpp"

namespace fragmotion {

enum class Look {
  as_captured,  ///< As the takes have it.
  ahead,        ///< Where it goes; as captured while it stands or goes back.
  at            ///< At a place.
};

/// Lets head and chest look somewhere, over whatever plays, as far as in the takes or easily (gaze_range.hpp) and, seen
/// from the world, no faster than kTurnsAtMost times as fast as a head turns in them. What is behind the character it
/// looks for over the shoulder over which it looked last. Does nothing to a skeleton without a head. Allocates nothing
/// once it is made.
class Gaze {
 public:
  explicit Gaze(Workspace& workspace) : workspace_(&workspace) {}

  /// Looks as captured.
  void reset() { *this = Gaze(*workspace_); }
  /// `place`: in the world, m; it counts where it looks at a place.
  void look(Look look, const Vector3& place);
  Look looks() const { return look_; }
  const Vector3& place() const { return place_; }

  /// Whether the head goes with what plays.
  bool rests() const { return workspace_->look.empty() || (look_ == Look::as_captured && !turned_); }
  /// Otherwise turns Workspace::shown, `seconds` after the pose that was shown last, of a character that goes by a
  /// command and turns at `turn_rate` rad/s at a turn of 1.
  void apply(const Control& command, double turn_rate, double seconds);

 private:
  friend struct PlayerState;

  // Where it looks: to the left, seen from where the character faces, and up; rad.
  using Angles = Vector2;
  struct Seen {
    Vector3 eyes;
    Quaternion rotation;  // of the head, in the world
    Angles angles;
  };

  Seen see() const;
  Angles angles(const Quaternion& rotation) const;
  Angles angles(const Vector3& way) const;
  std::optional<Angles> wanted(const Seen& seen, const Control& command, double turn_rate) const;
  Angles towards(const Vector3& eyes) const;
  Angles within(Angles angles) const;
  Angles advance(const Angles& wanted, bool begins, double seconds);
  double fastest() const;
  double chest_of(double turn) const;
  void turn(double chest, const Angles& to);
  bool hold_back(double seconds);
  void put_off(const Angles& shown, const Angles& wanted);

  Workspace* workspace_;
  Look look_ = Look::as_captured;
  Vector3 place_ = Vector3::Zero();
  bool turned_ = false;                       // whether what was shown last looked elsewhere than captured
  bool wants_ = false;                        // whether it was to look elsewhere than captured
  bool begins_ = false;                       // whether it is to look at something else from now on
  Angles wanted_ = Angles::Zero();            // when it was shown last
  Quaternion head_ = Quaternion::Identity();  // of the bone, likewise, in the world
  std::array<Approach, 2> offset_;            // of what is shown from what is wanted
  double due_ = 0;                            // s in which there is to be none
};

}  // namespace fragmotion

// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>

#include "base/approach.hpp"
#include "runtime/workspace.hpp"

namespace fragmotion {

/// What a hand holds or reaches for.
struct HandAim {
  /// Of the palm, m: in the world or, where it is carried, seen from the character frame and from the ground under it.
  Vector3 place = Vector3::Zero();
  double weight = 0;  ///< 0: the hand is as captured, 1: it is there.
  bool carried = false;
};

/// Lets hands hold things or reach for them, over whatever plays: two-bone inverse kinematics of the arm, and beyond
/// nine tenths of its length a lean of the trunk. A hand goes to another place or weight smoothly: in half a second or
/// so, or, where it is told little by little, until it is told the next time. It reaches for nothing that is far out of
/// its reach, or behind it. Arms and trunk turn from how they are captured hardly faster than in a quick reach: what
/// the character runs by it lets go in a swing. Does nothing to a skeleton without arms. Allocates nothing once it is
/// made.
class Reaching {
 public:
  explicit Reaching(Workspace& workspace) : workspace_(&workspace) {}

  /// Both hands are as captured.
  void reset() { *this = Reaching(*workspace_); }
  /// `side`: 0 left, 1 right.
  void reach(int side, const HandAim& aim);
  const HandAim& aim(int side) const { return hands_[side].aim; }
  /// Lets what it needs while hands are as captured be on its way to the processor.
  void prefetch() const { prefetch_between(&idles_, &hands_); }

  /// Changes Workspace::shown, `seconds` after the pose that was shown last, where the ground under the character is at
  /// the height `level`, m.
  void apply(double level, double seconds);

 private:
  friend struct PlayerState;

  // How a bone is turned from how it is captured, seen from its parent: as is wanted, but for an offset that goes.
  struct Turn {
    Quaternion wanted = Quaternion::Identity();
    std::array<Approach, 3> offset;  // rad, an axis as long as the angle is
    double due = 0;                  // s in which there is to be none

    bool is_off() const { return !(offset[0].rests() && offset[1].rests() && offset[2].rests()); }
    bool rests() const { return wanted.w() == 1 && !is_off(); }
    Quaternion shown() const;
    void follow(const Quaternion& next, double seconds);
  };
  struct Hand {
    HandAim aim;
    std::array<Approach, 3> place;  // as it is followed, in the aim's space
    Approach weight;                // likewise
    double place_due = 0, weight_due = 0;
    double since = 0;           // s since it was told, as far as that counts
    std::array<Turn, 2> turns;  // of the upper and the lower arm

    bool rests() const { return weight.rests() && aim.weight == 0; }
    bool hangs() const { return turns[0].rests() && turns[1].rests(); }
    Vector3 at() const { return {place[0].value, place[1].value, place[2].value}; }
    Vector3 speed() const { return {place[0].speed, place[1].speed, place[2].speed}; }
    void set(const Vector3& value, const Vector3& speed);
  };
  struct Goal {
    Vector3 place;
    double weight;  // by which that is between where the palm is captured and what it is to reach
  };
  using Goals = std::array<std::optional<Goal>, 2>;

  void follow_frame(double level, double seconds);
  void convert(Hand& hand, bool carried) const;
  void see() const;
  Vector3 world_place(const Hand& hand) const;
  std::optional<Goal> goal(int side) const;
  Vector3 wanted_lean(const Goals& goals) const;
  bool lean(const Goals& goals, double seconds);
  void bend(int side, const std::optional<Goal>& goal, double seconds);

  Workspace* workspace_;
  bool idles_ = false;               // nothing of the hands changes until one reaches
  CharacterFrame frame_;             // as it was shown last
  double level_ = 0;                 // likewise
  Vector2 speed_ = Vector2::Zero();  // of the frame, m/s
  double turning_ = 0;               // likewise, rad/s
  std::array<Hand, 2> hands_;
  Vector3 lean_ = Vector3::Zero();  // of the trunk, seen from the frame: an axis, as long as the angle is, rad
};

}  // namespace fragmotion

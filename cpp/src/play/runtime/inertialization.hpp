// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "base/simd.hpp"
#include "motion/packed_clip.hpp"
#include "motion/pose.hpp"
#include "runtime/player_constants.hpp"

namespace fragmotion {

/// How far a bone is turned from its motion, as modified Rodrigues parameters, and how fast that changes a second.
struct TurnOffset {
  Vector3 turn, turning;
};

/// From a new motion to an old one, whose rotations [4] are also given as both go on `apart` seconds later.
TurnOffset turn_offset(const double* old, const double* old_later, const double* fresh, const double* fresh_later,
                       double apart);

/// What is left of the offsets and of the speeds of a stitch that fades like a critically damped spring.
struct Fade {
  double offset = 0, speed = 0;
};

/// A stitch that keeps pose and velocity (D. Bollo, "Inertialization: high-performance animation transitions in Gears
/// of War", GDC 2018): the new motion is shown with the old one's offset and relative speed, which fade like a
/// critically damped spring. (Against Bollo's polynomials and the paper's ease-in-ease-out weights of the same
/// smoothness at the beginning, it is at its fastest little more than half as fast.) It needs nothing of the old motion
/// once it has begun, so it may begin anew at any time. How fast the root goes over the ground is not faded here: that
/// is a body's velocity (root_governor.hpp).
class Inertialization {
 public:
  /// The constants must outlive it.
  explicit Inertialization(int bones, const StitchConstants& constants = kUsualStitch);

  /// Nothing to fade.
  void clear() { end_ = 0; }

  /// Whether anything is left `time` seconds after the beginning.
  bool active(double time) const { return time < end_; }

  /// From `old` to `fresh`: after `seconds` little of the offset is left (StitchConstants), after four times that
  /// nothing. The poses are those of turn_offset(). Returns how much faster the old root goes over the ground, m/s.
  /// Turns are kept in the order of the clip that is shown fresh, or without one in that of the bones.
  Vector2 begin(const WorldPose& old, const WorldPose& old_later, const WorldPose& fresh, const WorldPose& fresh_later,
                double apart, double seconds, const PackedClip* clip = nullptr);

  /// Lets its memory be on its way to the processor.
  void prefetch() const { fragmotion::prefetch(offsets_.data(), offsets_.size()); }

  /// What is left `time` seconds after the beginning.
  Fade left(double time) const;
  /// The turns of which so much is left.
  FadingTurns turns(const Fade& left) const;
  /// Adds it to the hips' place and the heading.
  void move(const Fade& left, WorldPose& pose) const;
  /// Adds what is left `time` seconds after the beginning to a pose of no clip.
  void apply(double time, WorldPose& pose) const;

  const StitchConstants& constants() const { return *constants_; }
  /// `time` seconds after the beginning of a stitch of this damping, 1/s.
  Fade fade(double damping, double time) const;
  /// Keeps another offset of a bone, by its number in the order of the clip, whose own is lost.
  void keep(int lane, const TurnOffset& offset);
  /// The rotation of which so much is left.
  Quaternion turn(int lane, const Fade& left) const;

 private:
  friend struct PlayerState;

  int bones() const { return (static_cast<int>(offsets_.size()) - kBoneBlock + 1) / 6; }
  std::size_t slot(int lane, int value) const;

  const StitchConstants* constants_;
  double damping_ = 0, end_ = 0;  // 1/s, s
  Vector3 root_ = Vector3::Zero(), root_speed_ = Vector3::Zero();
  double heading_ = 0, heading_speed_ = 0;
  // As FadingTurns has them.
  std::vector<float> offsets_;
};

}  // namespace fragmotion

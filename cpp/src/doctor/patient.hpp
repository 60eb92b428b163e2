// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <string>
#include <vector>

#include "fragmotion/doctor/examine.hpp"
#include "fragmotion/motion/clip.hpp"
#include "fragmotion/skeleton/role_map.hpp"

namespace fragmotion {

using Findings = std::vector<Finding>;

constexpr double kStature = 1.8;  // m: what thresholds of length are for

/// A leg or an arm by its joints, from the body on; -1 where there is none.
struct Limb3 {
  int top = -1, middle = -1, end = -1;

  bool whole() const { return top >= 0 && end >= 0; }
};

/// A take with what the checks need of it.
class Patient {
 public:
  explicit Patient(Take take);

  const Take& take() const { return take_; }
  const RoleMap& roles() const { return roles_; }
  int frames() const { return take_.frames; }
  int bones() const { return take_.skeleton.size(); }
  double rate() const { return take_.rate; }
  double stature() const { return stature_; }
  /// What makes lengths those of a character of 1.8 m; 0 where the bones have no length.
  double scale() const { return stature_ > 0 ? kStature / stature_ : 0; }
  /// Whether every number is there.
  bool is_finite() const { return finite_; }

  Vector3 head(int frame, int bone) const { return load_vector(&positions_[at(frame, bone) * 3]); }
  Vector3 tip(int frame, int bone) const;
  Quaternion local(int frame, int bone) const { return load_quaternion(&take_.rotations[at(frame, bone) * 4]); }
  /// The place of a frame's and bone's values in arrays [frames, bones].
  std::size_t at(int frame, int bone) const { return static_cast<std::size_t>(frame) * bones() + bone; }

  /// The ends of each leg and arm, left and right.
  std::array<Limb3, 2> legs, arms;
  int hips = -1, skull = -1;
  std::array<int, 2> toes = {-1, -1};
  std::array<std::vector<int>, 2> feet;  ///< Each leg's foot and all joints below, toes that no role tells among them.

  bool has_legs() const { return legs[0].whole() && legs[1].whole(); }
  bool has_arms() const { return arms[0].whole() && arms[1].whole(); }
  /// Where a foot points: from its head to the toe's, or to its tip.
  Vector3 toe_direction(int frame, int side) const;
  /// The bones' lengths moved from the frame before, a mean of all bones, m.
  double step(int frame) const;

  /// The frame of the file that a frame was, where others have been cut off or filled in.
  int source(int frame) const { return sources_[frame]; }
  /// Takes the take and, for each of its frames, which of the frames till now it is.
  void become(Take take, const std::vector<int>& frames);
  void become(Take take);

 private:
  void look();
  void find_parts();

  Take take_;
  RoleMap roles_;
  double stature_ = 0;
  bool finite_ = true;
  std::vector<double> positions_, rotations_;  // of all bones in the world
  std::vector<int> sources_;
};

/// The take at rest, in one frame.
Take resting_take(const Skeleton& skeleton);

/// These frames of a take alone.
Take frames_of(const Take& take, const std::vector<int>& frames);

/// A finding of frames `begin` to `end`.
Finding found(const char* code, Severity severity, int begin, int end, std::string text);
/// The same, to be mended.
Finding mendable(Finding finding, bool safe = true);
/// Of the whole take.
Finding found(const Patient& patient, const char* code, Severity severity, std::string text);

}  // namespace fragmotion

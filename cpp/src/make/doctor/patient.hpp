// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "doctor/examine.hpp"
#include "doctor/tracks.hpp"
#include "motion/clip.hpp"
#include "skeleton/role_map.hpp"

namespace fragmotion {

using Findings = std::vector<Finding>;

/// Whether that may be a person's stature: a child's, or a hero's, m.
inline bool is_person(double stature) { return stature >= 0.9 && stature <= 2.6; }

/// Whether that may be the stature() of an animal on four legs: a rat's, or a game's that is larger than life, m.
inline bool is_animal(double stature) { return stature >= 0.1 && stature <= 15; }

/// s: what is shorter is no step, and no pose that somebody holds.
constexpr double kShortestStep = 0.3;

/// m/s of a character of 1.8 m: feet that stand are slower, and the bones of somebody who holds a pose.
constexpr double kStill = 0.15;

/// Of what is unlike what should be: what an explanation leaves of it at most.
constexpr double kLeft = 0.4;

/// A leg or an arm by its joints, from the body on; -1 where there is none.
struct Limb3 {
  int top = -1, middle = -1, end = -1;

  bool whole() const { return top >= 0 && end >= 0; }
};

/// Frames begin to end, the last included.
struct Run {
  int begin = 0, end = 0;

  int length() const { return end - begin + 1; }
  bool operator==(const Run& other) const { return begin == other.begin && end == other.end; }
};

/// A bone in its parent.
struct Local {
  Vector3 place = Vector3::Zero();
  Quaternion rotation = Quaternion::Identity();
};

/// A take with what the checks need of it. What is mended is kept beside the take, and poses are worked out when they
/// are looked at: a take of hours is neither copied nor held twice. For one thread at a time.
class Patient {
 public:
  using Tick = std::function<void()>;

  /// The take must outlive the patient. `tick` is called now and then, and ends the examination by throwing.
  explicit Patient(const Take& take, Tick tick = {});
  explicit Patient(const Take&& take, Tick tick = {}) = delete;
  /// At rest, in one frame.
  explicit Patient(const Skeleton& skeleton);

  const Skeleton& skeleton() const { return skeleton_; }
  const RoleMap& roles() const { return roles_; }
  int frames() const { return static_cast<int>(shown_.size()); }
  int bones() const { return skeleton_.size(); }
  double rate() const { return rate_; }
  double unit() const { return unit_; }
  double stature() const { return stature_; }
  /// What makes lengths those of a character of 1.8 m; 0 where the bones have no length.
  double scale() const { return scale_; }
  /// Whether every number is there.
  bool is_finite() const;

  Vector3 head(int frame, int bone) const { return load_vector(&posed(frame).heads[std::size_t{3} * bone]); }
  Vector3 tip(int frame, int bone) const;
  Local local(int frame, int bone) const;
  /// Whether a frame is the one before, to the bit.
  bool repeats(int frame) const;

  /// The ends of each leg and arm, left and right; a four-legged body has the fore legs after the hind ones, and no
  /// arms.
  std::vector<Limb3> legs;
  std::array<Limb3, 2> arms;
  int hips = -1, skull = -1;           ///< Without a head, the uppermost bone of neck or spine.
  std::vector<int> toes;               ///< Of each leg; -1 where it has none.
  std::vector<std::vector<int>> feet;  ///< Each leg's foot and all joints below, toes that no role tells among them.

  bool is_four_legged() const { return legs.size() == kMostLegs; }
  /// Whether it has the size of what it is.
  bool is_life_size() const { return is_four_legged() ? is_animal(stature_) : is_person(stature_); }
  bool has_legs() const { return legs[0].whole() && legs[1].whole(); }
  bool has_arms() const { return arms[0].whole() && arms[1].whole(); }
  /// The last bone of a leg that has a role: its toe, or its foot.
  int last_bone(int leg) const { return toes[leg] >= 0 ? toes[leg] : legs[leg].end; }
  /// Where a foot points: from its head to the toe's, or to its tip.
  Vector3 toe_direction(int frame, int leg) const;
  /// The bones' lengths moved from the frame before, a mean of all bones, m.
  double step(int frame) const;
  /// As tracks_of(), which is asked once.
  const std::optional<Tracks>& tracks() const;

  /// The frame of the file that a frame was, where others have been cut off or filled in.
  int source(int frame) const { return shown_[frame].frame; }
  /// Frames `run` as they are now.
  Take part(const Run& run) const;
  Take take() const { return part({0, frames() - 1}); }

  /// Reads the take with other axes, and unit: every vector v becomes `scale` `basis` v, every rotation R `basis` R
  /// `basis`^-1. The basis is orthogonal; one that mirrors makes the mirror image.
  void change_basis(const Eigen::Matrix3d& basis, double scale = 1);
  /// Interpolates a bone over a run from the frames beside it; at an end of the take the bone stays as beside it, and
  /// where nothing is left it rests.
  void bridge(int bone, const Run& run);
  /// These frames alone, `copies` times slower.
  void keep(const std::vector<int>& frames, int copies = 1);
  /// So many frames more before each, on the way to it from the one before.
  void fill_in(const std::vector<int>& counts);
  /// Moves the body.
  void move(const Vector3& way);
  /// Takes the world of each frame, as long as no frame is added or left out, to the ground of a character frame.
  void place(std::vector<CharacterFrame> places);

 private:
  /// A frame of the file; where `weight` is less than 1, that part of the way to it from the frame `before`.
  struct Shown {
    int frame = 0, before = 0;
    double weight = 1;
  };
  /// Values as in Take; those of the world once they are asked for.
  struct Pose {
    int frame = -1;
    bool posed = false;
    std::vector<double> places, rotations, heads, turns;
  };

  Patient(std::shared_ptr<const Take> file, Tick tick);
  void find_parts();
  void add_leg(Side side, Role top, Role middle, Role end, Role toe);
  void find_size();
  void forget();
  const Pose& pose(int frame) const;
  const Pose& posed(int frame) const;
  Local shown(int frame, int bone) const;
  Local in_file(int frame, int bone) const;
  std::size_t at(int frame, int bone) const { return static_cast<std::size_t>(frame) * bones() + bone; }

  std::shared_ptr<const Take> file_;
  Tick tick_;
  Skeleton skeleton_;
  RoleMap roles_;
  double rate_ = 0, unit_ = 1, stature_ = 0, scale_ = 0;
  mutable std::optional<bool> finite_;

  std::vector<Shown> shown_;
  bool turned_ = false;
  Eigen::Matrix3d basis_ = Eigen::Matrix3d::Identity(), matrix_ = Eigen::Matrix3d::Identity();
  Vector3 way_ = Vector3::Zero();
  std::vector<CharacterFrame> places_;              // by frame; none where all stays
  std::vector<char> is_bridged_;                    // by frame of the file
  std::unordered_map<std::size_t, Local> bridged_;  // by frame of the file and bone
  mutable std::vector<Pose> poses_;                 // that were looked at lately
  mutable std::shared_ptr<std::optional<Tracks>> tracks_;
  mutable int worked_out_ = 0;
};

/// A finding of frames `begin` to `end`.
Finding found(const char* code, Severity severity, int begin, int end, std::string text);
/// The same, to be mended.
Finding mendable(Finding finding, bool safe = true);
/// Of the whole take.
Finding found(const Patient& patient, const char* code, Severity severity, std::string text);

}  // namespace fragmotion

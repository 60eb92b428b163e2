// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>

#include "fragmotion/performance.hpp"
#include "fragmotion/random.hpp"

namespace fragmotion {

/// Seconds over which two fragments are stitched, unless told.
constexpr double kStitch = 0.15;

/// The run time (Sec. 3.3, Fig. 3). At a fragment's end the table tells the next class. A member of it, drawn at random
/// (Sec. 3.1) among those that perform the control as well as the representative or better, is placed where the
/// character stands, and stitched on: over a set time the old fragment goes on in its take while translations are
/// interpolated linearly and rotations by slerp, with ease-in-ease-out weights. A fragment is left early, once stitched
/// and unless in the air, when the control changes a lot. A stand-in-place fragment is played to its end; then comes
/// the class that it leads to, or, where the control has changed a lot meanwhile, what the table tells from standing. A
/// jump that is pressed, however shortly, is asked of the table at the next decision.
class Player {
 public:
  /// `stitch` seconds are cut short by shorter fragments; `policy` is one of the character's, or empty for the one that
  /// drives. Throws std::invalid_argument unless stitch is 0 .. 1 s, and on an unknown policy.
  explicit Player(std::shared_ptr<const Character> character, std::uint64_t seed = 1, double stitch = kStitch,
                  const std::string& policy = {});

  /// Stands at `frame`, in the class that best performs standing still, and draws again from the seed: after a reset
  /// the same steps show the same poses.
  void reset(const CharacterFrame& frame = {});

  /// Plays on for `seconds` under a control, which need not be one of the 102 points. Throws std::invalid_argument
  /// unless the control is finite and `seconds` is 0 .. 3600.
  void step(const Control& control, double seconds);

  const Vector3& root_position() const { return root_; }
  /// [bones, 4] as in Clip.
  const std::vector<double>& rotations() const { return rotations_; }
  CharacterFrame frame() const;
  int playing_class() const { return class_; }
  int playing_fragment() const { return now_.fragment; }
  /// Eq. 2 for the transition that led here and the control.
  double quality(int control) const;

  /// Steps through a trace from now: frames 0 .. round(duration * rate), each control for 1/kTraceRate s.
  Performance run(const Trace& trace, double rate, const Progress& progress = {});

  const Character& character() const { return *character_; }

 private:
  // A fragment that plays, placed in the world: its clip turned by `heading` about z and moved by `offset`.
  struct Placed {
    int fragment = 0;
    double seconds = 0;  // since its first pose
    double heading = 0;
    Vector2 offset = Vector2::Zero();
  };

  Placed place(int fragment, const CharacterFrame& frame) const;
  Vector3 sample(const Placed& placed, double* rotations) const;
  double heading(const Placed& placed) const;
  int draw(int next_class, const Control& control);
  void start(int next_class, const Control& control);
  bool changed(const Control& wanted) const;
  int decide(const Control& wanted);
  bool leaves_early(const Control& wanted) const;
  void go_on(const Control& control, const Control& wanted);
  void show();
  void judge(Performance& p, const Control& control, const CharacterFrame& before) const;
  double left() const;

  std::shared_ptr<const Character> character_;
  const Policy* policy_;
  Kinematics kinematics_;
  std::vector<std::vector<int>> members_;
  std::vector<int> fitting_;  // scratch of draw()
  std::uint64_t seed_;
  Random random_;
  double stitch_;

  Placed now_, before_;
  double stitching_ = 0;  // s that the stitch under way lasts; 0: none
  int class_ = 0, from_ = 0;
  int waiting_ = -1;  // the class that follows a stand-in-place fragment
  Control decided_for_;
  bool jump_pressed_ = false;
  bool jump_waits_ = false;  // pressed since the last decision that plays: a tap is not lost
  Vector3 root_;
  double heading_ = 0;
  std::vector<double> rotations_, other_;
};

}  // namespace fragmotion

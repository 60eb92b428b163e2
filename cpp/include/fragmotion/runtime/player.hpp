// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>

#include "fragmotion/base/random.hpp"
#include "fragmotion/evaluate/performance.hpp"
#include "fragmotion/fragments/distance.hpp"
#include "fragmotion/motion/foot_lock.hpp"
#include "fragmotion/runtime/breathing.hpp"
#include "fragmotion/runtime/inertialization.hpp"

namespace fragmotion {

/// How the next fragment joins on to what is shown (Fig. 3).
enum class Stitching {
  inertialize,  ///< It takes over pose and velocity, whose differences fade (inertialization.hpp).
  crossfade     ///< The paper's: the old fragment goes on in its take while both are interpolated.
};

/// Seconds that a stitch takes, unless told: a crossfade all, inertialization most of its way (inertialization.hpp).
constexpr double kStitch = 0.2;

/// Seconds that a fragment is played at least before a change of the control may end it.
constexpr double kSoonest = 0.1;

struct PlayerOptions {
  std::uint64_t seed = 1;
  double stitch = kStitch;  ///< s, 0 .. 1; shorter fragments cut a crossfade short.
  std::string policy{};     ///< One of the character's; empty: the one that drives.
  Stitching stitching = Stitching::inertialize;
  bool lock_feet = true;  ///< Planted feet stay where they are (foot_lock.hpp).
  /// How much the root is pulled to the command, over what its fragments do, 0 .. 1; at 1 by up to two fifths of the
  /// fragment's speed and of the turn rate.
  double pull = 1;
  /// How soon a fragment is left when the control changes a lot, 0 .. 1: at 0 at the moment of it from which the next
  /// one is joined best, at 1 at once.
  double promptness = 0.5;
};

/// The run time (Sec. 3.3, Fig. 3). At a fragment's end the table tells the next class. A member of it, drawn at random
/// (Sec. 3.1) among those that perform the control as well as the representative or better and join well, is placed
/// where the character stands, and stitched on with ease-in-ease-out weights. A fragment is left early, unless in the
/// air, when the control changes a lot: soon, where the next one joins well. A stand-in-place fragment is played to its
/// end; then comes the class that it leads to, or, where the control has changed a lot meanwhile, what the table tells
/// from standing. A jump that is pressed, however shortly, comes with the next decision, if the table knows any.
class Player {
 public:
  /// Throws std::invalid_argument on an option that is out of its range.
  explicit Player(std::shared_ptr<const Character> character, const PlayerOptions& options = {});
  Player(const Player&) = delete;
  Player(Player&&) = default;

  /// Stands at `frame`, in the class that best performs standing still, and draws again from the seed: after a reset
  /// the same steps show the same poses. Throws std::invalid_argument unless `frame` is within 1e9 m and 1e9 rad.
  void reset(const CharacterFrame& frame = {});

  /// Plays on for `seconds` under a control, which need not be one of the 102 points. Allocates nothing. Throws
  /// std::invalid_argument unless the control is finite and `seconds` is 0 .. 3600.
  void step(const Control& control, double seconds);

  /// Plays a member of this class, drawn at random, whatever the policy says: as soon as the stitch under way is done,
  /// and to its end, from where the policy goes on. Throws std::invalid_argument on a class that does not exist.
  void force(int next_class);

  const Vector3& root_position() const { return root_; }
  /// [bones, 4] as in Clip; of a crowd's player see Crowd::step.
  const std::vector<double>& rotations() const { return stage_->shown.rotations; }
  CharacterFrame frame() const;
  int playing_class() const { return class_; }
  int playing_fragment() const { return now_.fragment; }
  /// Eq. 2 for the transition that led here and the control.
  double quality(int control) const;

  /// Steps through a trace from now: frames 0 .. round(duration * rate), each control for 1/kTraceRate s.
  Performance run(const Trace& trace, double rate, const Progress& progress = {});

  const Character& character() const { return *character_; }

 private:
  friend class Crowd;

  // What players that step in turn share: what never changes, and what a step keeps nothing in.
  struct Stage {
    explicit Stage(const Character& character);

    Kinematics kinematics;
    std::shared_ptr<FootLock::Body> body;
    std::vector<std::vector<int>> members;
    std::array<BodyTips, 3> tips;
    std::vector<float> onward;                   // tips of what is shown, and of how it would go on
    std::vector<std::pair<float, int>> fitting;  // fragments by their distance from it
    WorldPose shown;                             // by the player that stepped last
    std::array<WorldPose, 4> poses;
  };

  // A fragment that plays, placed in the world: its clip turned by `heading` about z and moved by `offset`.
  struct Placed {
    int fragment = 0;
    double seconds = 0;  // since its first pose
    double heading = 0;
    Vector2 offset = Vector2::Zero();
  };

  Player(std::shared_ptr<const Character> character, const PlayerOptions& options, std::shared_ptr<Stage> stage);

  void fetch() const;
  static void check_step(const Control& control, double seconds);
  Placed place(int fragment, const CharacterFrame& frame) const;
  void sample(const Placed& placed, WorldPose& pose) const;
  void stitch(const Placed& old);
  void sample_shown(Placed placed, double seconds, WorldPose& pose) const;
  CharacterFrame pose_tips(double seconds, BodyTips& tips) const;
  void find_onward(const CharacterFrame& frame, const BodyTips& before, const BodyTips& now) const;
  bool obeys(int fragment, const Control& wanted) const;
  bool turns_back(int fragment, const Control& wanted) const;
  void find_fitting(int next_class, const Control& control) const;
  float measure_fitting() const;
  int draw(int next_class, const Control& control);
  double find_exit(const Control& wanted) const;
  void start(int next_class, int fragment);
  void start_forced();
  bool changed(const Control& wanted) const;
  int tell(const Control& wanted) const;
  int decide(const Control& wanted);
  bool leaves_early(const Control& wanted);
  void go_on(const Control& control, const Control& wanted);
  void pull(const Control& control, double seconds);
  void pose();
  void crossfade(double weight, WorldPose& pose) const;
  bool stands(const Control& evident) const;
  void plant(double seconds);
  double left() const;

  std::shared_ptr<const Character> character_;
  const Policy* policy_;
  std::shared_ptr<Stage> stage_;
  std::uint64_t seed_;
  Random random_;
  double stitch_;
  Stitching stitching_;
  bool lock_feet_;
  double pull_, promptness_;

  Placed now_, before_;
  double faded_ = 0;    // s after which the old fragment has faded; 0: it does not fade
  double soonest_ = 0;  // s after which what plays may be left early
  int class_ = 0, from_ = 0;
  int entered_ = 0;    // fragments begun
  int waiting_ = -1;   // the class that follows a stand-in-place fragment
  int forced_ = -1;    // the class that force() asked for and that does not play yet
  bool held_ = false;  // a forced fragment plays: it is not left early
  Control decided_for_;
  Control planned_for_;
  double exit_ = -1;  // s after which what plays is left early for planned_for_; below 0: nothing is planned
  bool jump_pressed_ = false;
  bool jump_waits_ = false;            // pressed since the last decision that plays: a tap is not lost
  Vector2 pulling_ = Vector2::Zero();  // m/s, in the character frame
  double turning_ = 0;                 // rad/s
  Inertialization inertia_;
  FootLock foot_lock_;
  Breathing breathing_;
  Vector3 root_ = Vector3::Zero();  // as it is shown
  double heading_ = 0;
};

}  // namespace fragmotion

// SPDX-License-Identifier: MIT
#pragma once

#include "fragments/hips_velocity.hpp"
#include "runtime/look_stitch.hpp"
#include "runtime/step_sequence.hpp"
#include "runtime/workspace.hpp"

namespace fragmotion {

/// When both feet stand next before the one that stands is lifted: s until then, 0 where they do, and s that they do so
/// from then on, a frame at least.
struct BothStand {
  double begins = -1;  ///< -1: they do not
  double lasts = 0;
};

/// A stitch that is to take less is none, s.
constexpr double kShortestStitch = 0.001;

/// How the next fragment joins on to what is shown (Fig. 3).
enum class Stitching {
  inertialize,  ///< It takes over pose and velocity, whose differences fade (inertialization.hpp).
  crossfade     ///< The paper's: the old fragment goes on in its take while both are interpolated.
};

/// Markers that were passed; beyond the most of them in one step none is told.
struct PassedMarkers {
  std::array<const Marker*, 8> markers{};  ///< The character's.
  int count = 0;

  const Marker* const* begin() const { return markers.data(); }
  const Marker* const* end() const { return markers.data() + count; }
};

/// Plays one fragment after another, each placed where the character stands and stitched on to what is shown
/// (Sec. 3.3, Fig. 3). Allocates nothing once it is made.
class Playback {
 public:
  /// `stitch` as PlayerOptions::stitch. Plays in the character's first style. Character and workspace must outlive it.
  Playback(const Character& character, Workspace& workspace, Stitching stitching, double stitch);

  /// What is begun from now on is of this style, but for moves, which are the character's.
  void change_style(int style) { style_ = style; }
  /// As PlayerOptions::stitch, of the stitches that begin from now on.
  void set_stitch(double stitch) { stitch_ = stitch < kShortestStitch ? 0 : stitch; }
  /// Whether poses are joined without the speeds of bones, which nobody sees from far away.
  void set_far_away(bool far_away) { far_away_ = far_away; }
  /// Nothing but this fragment plays, from its first pose, placed at `frame`.
  void reset(int fragment, const CharacterFrame& frame);
  /// Stitches a fragment on to what is shown. Returns how much faster what played went over the ground, m/s in the
  /// character frame: a stitch with inertialization leaves it to the caller to let a body go on so. 0 with a crossfade.
  Vector2 start(int fragment);
  /// The same of a part of a move.
  Vector2 start_move(int part);
  void advance(double seconds);
  /// The markers of the clips that play: passed since forget_markers(), from the first pose that is played of a clip
  /// on.
  const PassedMarkers& passed() const { return passed_; }
  void forget_markers() { passed_.count = 0; }
  /// Moves the character for `seconds` at a velocity, m/s in its own frame, and a turn rate, rad/s.
  void move(const Vector2& velocity, double turn_rate, double seconds);

  /// Writes what plays to Workspace::shown.
  void show();
  /// Finds frame() as show() does, without the pose.
  void find_frame();
  /// As it is shown at a time since the fragment's first pose, without a crossfade's old fragment.
  void sample(double seconds, WorldPose& pose) const;
  /// Likewise, but for neck and head, which are somewhere between the old and the new motion.
  void sample_body(double seconds, WorldPose& pose) const;

  /// What plays.
  const Fragment& fragment() const { return fragment(now_); }
  const Control& evident() const { return fragment().evident; }
  /// evident(), but with hips_velocity().
  const Control& evident_of_hips() const { return evident_of_hips_; }
  /// How the hips go over the ground now, without the sway and the ripple of a step: over the fragment, at the velocity
  /// of evident_of_hips().
  Travel mean_travel() const;
  /// Those of the steps that what plays is one of or a part of.
  double step_seconds() const;
  /// Its number, as Character::played() has it in its style.
  int number() const { return now_.number; }
  bool plays_move() const { return now_.number >= static_cast<int>(styled(now_).pool.fragments.size()); }
  /// Of the clip that plays.
  const Contacts& contacts() const { return styled(now_).contacts[fragment().clip]; }
  /// Whether it is in a jump that cannot be left: until it has landed and is half up again.
  bool is_jumping() const;
  /// Whether it is in no jump, or has landed from it; without contacts, when it could be left.
  bool has_landed() const;
  /// Whether it jumps and touches no ground now.
  bool is_in_the_air() const;
  /// The frame of the clip that is shown now.
  double at() const { return fragment().first_played() + now_.seconds * clip(now_).rate; }
  /// The frame of the clip that is nearest to now, and to a time since the fragment's first pose, s.
  std::size_t frame_of_clip() const { return frame_of_clip(now_.seconds); }
  std::size_t frame_of_clip(double seconds) const;
  /// Which feet stand at a time since the fragment's first pose, s.
  std::array<bool, 2> standing_feet(double seconds) const;
  /// Until a foot stands, as the take has it, s: 0 where it does; the take's end where it does not any more.
  double until_standing(int side) const;
  /// When both feet stand next, as the take has it.
  BothStand both_stand() const;
  /// How the feet came down so far.
  const StepSequence& steps() const { return steps_; }
  /// Since the first pose that is played of the fragment, s.
  double seconds() const { return now_.seconds; }
  /// Until the fragment's end, s.
  double left() const;
  /// At which the character goes as it is shown, m/s in its own frame.
  Vector2 velocity() const;
  /// After which the old fragment of a crossfade is not seen any more, s since the first pose of what plays.
  double faded() const { return faded_; }
  /// Where the character stands, as it was last shown.
  const CharacterFrame& frame() const { return frame_; }
  /// The turn from the world to how it faces there.
  const PlaneTurn& facing() const { return facing_; }

  void prefetch() const { inertialization_.prefetch(); }

 private:
  friend struct PlayerState;

  // A fragment that plays, placed in the world: its clip turned by `heading` about z and moved by `offset`.
  struct Placed {
    int style = 0;
    int number = 0;      // as Character::played() has it in that style
    double seconds = 0;  // since its first pose
    double heading = 0;
    Vector2 offset = Vector2::Zero();
  };

  const Character& styled(const Placed& placed) const { return character_->in_style(placed.style); }
  const Fragment& fragment(const Placed& placed) const { return styled(placed).played(placed.number); }
  const PackedClip& clip(const Placed& placed) const { return styled(placed).pool.clips[fragment(placed).clip]; }
  Placed place(int style, int number, const CharacterFrame& frame) const;
  Vector2 start(const Placed& next);
  void play(const Placed& placed);
  static void put(const Placed& placed, const PlaneTurn& half, const RootPose& root, WorldPose& pose);
  void sample(const Placed& placed, WorldPose& pose, const FadingTurns& fading = {}) const;
  void sample_stitched(Placed placed, double seconds, bool looks, WorldPose& pose) const;
  Vector2 begin_stitch(const Placed& old);
  Vector2 begin_far_stitch(const Placed& old, const Vector2& went);
  bool goes_on(const Placed& next) const;
  Vector2 go_on(const Placed& next);
  void pass_markers(double after, double until);
  void crossfade(double weight, WorldPose& pose) const;
  void stand(const WorldPose& pose);

  const Character* character_;
  Workspace* workspace_;
  Stitching stitching_;
  int style_ = 0;
  double stitch_ = 0;
  bool far_away_ = false;
  Placed now_, before_;
  Control evident_of_hips_;
  Vector2 beside_ends_ = Vector2::Zero();  // evident_of_hips_ without mean_velocity_around()
  double faded_ = 0;
  double stitched_ = 0;  // s for which the stitch was under way when what plays began
  StepSequence steps_;
  PassedMarkers passed_;  // within a step, so that nothing of it is kept between two
  Inertialization inertialization_;
  LookStitch look_;
  double turning_ = 0;  // rad/s, at which it was moved last
  CharacterFrame frame_;
  PlaneTurn facing_{1, 0};
};

}  // namespace fragmotion

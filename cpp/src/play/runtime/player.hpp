// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "feet/feet_ahead.hpp"
#include "feet/ground.hpp"
#include "runtime/director.hpp"
#include "runtime/gaze.hpp"
#include "runtime/pose_correction.hpp"
#include "runtime/reaching.hpp"
#include "runtime/upper_body.hpp"

namespace fragmotion {

class GroundFollower;

/// Seconds that a stitch takes, unless told: a crossfade all, inertialization most of its way (inertialization.hpp).
constexpr double kStitch = 0.2;
/// s from now to the middle of a fragment that begins soon: what is asked for then is what it is to do.
constexpr double kSoon = 0.2;

struct PlayerOptions {
  std::uint64_t seed = 1;
  double stitch = kStitch;  ///< s, 0 .. 1; shorter fragments cut a crossfade short.
  std::string policy{};     ///< One of the character's; empty: the one that drives.
  Stitching stitching = Stitching::inertialize;
  bool lock_feet = true;  ///< Planted feet stay where they are (foot_lock.hpp).
  /// How much the root does of the command beyond what its fragments do, 0 .. 1; at 1 up to three fifths of the
  /// fragment's speed and the whole turn rate.
  double root_adjustment = 1;
  /// How soon a change of the control is followed, 0 .. 1. The velocity changes by 2.4 m/s^2 (of a 1.8 m character) at
  /// 0, by 4.8 at the default, which is what a body does, and at once at 1; and a fragment is left at 0 at the moment
  /// of it from which the next one is joined best, at 1 at once.
  double responsiveness = 0.5;
  PlayerConstants constants{};  ///< As they are: what `dev.py tune` changes.
  /// It is seen from far away: fragments are played to their ends, and what follows is looked up (Sec. 3.3) and joined
  /// as well as its class is, without a plan; all of a step is played at once, and no foot is held.
  bool far_away = false;
};

/// s in which a change of style looks for the moment that joins best.
constexpr double kStyleWait = 0.8;

/// The run time (Sec. 3.3, Fig. 3): a RootGovernor asks of the body what it can do and says where it goes, a Director
/// decides which class comes next and when, a FragmentSelector chooses one of its fragments, Playback stitches that on
/// to what is shown, and PoseCorrection lets the pose go with the root. Moves play in between (MoveTrack) or over it
/// (UpperBody); a Gaze looks somewhere over all that, and hands reach for things (Reaching).
class Player {
 public:
  /// Throws std::invalid_argument on an option that is out of its range.
  explicit Player(std::shared_ptr<const Character> character, const PlayerOptions& options = {});
  Player(Player&&) = default;

  /// A player that goes on as this one would. They share a workspace, as a crowd's do: step them in turn, and what
  /// rotations() tells is the pose of the one that stepped last.
  Player branch() const;
  /// A player of the same character, at its start, by options but for their constants, which are this one's. What never
  /// changes they share, so that it takes less time and memory than one made anew; they may step at the same time.
  Player another(const PlayerOptions& options) const;

  /// Stands at `frame` in a style, in the class that best performs standing still, and draws again from the seed: after
  /// a reset the same steps show the same poses. Throws std::invalid_argument unless `frame` is within 1e9 m and 1e9
  /// rad and the style exists.
  void reset(const CharacterFrame& frame = {}, int style = 0);

  /// Plays on by other options, but for the seed, the policy and the kind of stitching, which stay. Throws
  /// std::invalid_argument on an option that is out of its range.
  void set_options(const PlayerOptions& options);

  /// Draws from another seed, from the next reset on.
  void reseed(std::uint64_t seed) { selector_.reseed(seed); }

  /// Lets its memory be on its way to the processor: a crowd's is more than caches hold.
  void prefetch() const;

  /// Plays on for `seconds` under a control, which need not be a point of its space. Allocates nothing. Throws
  /// std::invalid_argument unless each number of the control is within kMostControl and `seconds` is 0 .. 3600.
  void step(const Control& control, double seconds);

  /// Goes on in another style: at the moment within kStyleWait at which it joins best, but after the landing of a jump
  /// and the end of a move of the whole body. One that waits already is forgotten. Classes and fragments are that
  /// style's from then on. Throws std::invalid_argument on a style that does not exist.
  void change_style(int style);
  int playing_style() const { return extras_ == nullptr ? 0 : extras_->style.playing; }
  /// Which waits for its moment, or -1.
  int waiting_style() const { return extras_ == nullptr ? -1 : extras_->style.waiting; }

  /// Plays a member of this class, drawn at random, whatever the policy says: as soon as the stitch under way is done,
  /// and to its end, from where the policy goes on. Throws std::invalid_argument on a class that does not exist.
  void force(int next_class);

  /// Plays a move, held from now on: at the moment within its time to wait at which it joins best on to what would be
  /// shown under the control until then, but not within a jump. One of the whole body goes its own way on the ground,
  /// and into the class that joins best for the control at its end; one of the upper body plays over all others. A move
  /// that waits already is forgotten, one that plays is played to its end before. Throws std::invalid_argument on a
  /// move that does not exist.
  void start_move(int move);
  /// The move is not held any more: its loop is not begun again. Throws std::invalid_argument on one that does not
  /// exist.
  void release_move(int move);
  /// What plays, or -1: a move of the whole body, and one of the upper body.
  std::array<int, 2> playing_moves() const;
  /// What waits for its moment, or -1, likewise.
  std::array<int, 2> waiting_moves() const;
  /// Head and chest look there from now on, at a place in the world, m, where that is Look::at (gaze.hpp); after a
  /// reset as captured. Throws std::invalid_argument unless the place is within 1e10 m.
  void look(Look look, const Vector3& place = Vector3::Zero());
  const Gaze& gaze() const { return gaze_; }
  /// What a hand (0 left, 1 right) holds or reaches for from now on (reaching.hpp); nothing after a reset. Throws
  /// std::invalid_argument unless there is the hand, its weight is 0 .. 1 and the place is within 1e10 m.
  void reach(int hand, const HandAim& aim);
  const Reaching& reaching() const { return *reaching_; }
  /// Stands and goes from now on on this ground (ground_follower.hpp), or, without one, on level ground at height 0.
  void stand_on(Ground ground);
  /// The ground is another than it was, or lies otherwise to where it plays: what feet know of it beyond what they
  /// stand on is asked for again.
  void forget_ground();
  /// The height of the ground under it, m, as its hips follow it.
  double ground_level() const;
  /// Since it stands on its ground, or a reset: s in which it asked for ground where there is none, and went on at the
  /// height that it had.
  double ground_missed() const;

  const Vector3& root_position() const { return root_; }
  /// [bones, 4] as in Clip; of a crowd's player see Crowd::step.
  const std::vector<double>& rotations() const { return workspace_->shown.rotations; }
  CharacterFrame frame() const { return playback_.frame(); }
  /// What plays.
  const Playback& playback() const { return playback_; }
  /// The velocity that it is commanded, m/s in the character frame, which its strides follow; of a move of the whole
  /// body and in the air, that which it has.
  Vector2 commanded_velocity() const;
  int playing_class() const { return director_.playing_class(); }
  /// While a move of the whole body plays, that before it, as playing_class().
  int playing_fragment() const { return fragment_; }
  /// Fragments, and parts of whole-body moves, begun since it was made.
  int entered() const { return entered_; }
  /// Eq. 2 for the transition that led here and the control. Throws std::invalid_argument on one that does not exist.
  double quality(int control) const;
  /// What the last step passed of its takes' markers, and of a move of the upper body. Valid as long as the character.
  std::array<PassedMarkers, 2> passed_markers() const;
  /// Until the fragment's end, s.
  double seconds_left() const { return playback_.left(); }
  /// Of the left and the right foot where the fragment has it stand (contacts.hpp): the middle of its sole as it is
  /// shown, m. In a crowd, of the player that stepped last.
  std::array<std::optional<Vector3>, 2> standing_feet() const;

  const Character& character() const { return *character_; }
  /// In the style that plays.
  const Character& styled_character() const { return character_->in_style(playing_style()); }

 private:
  friend class Crowd;
  friend struct PlayerState;

  Player(const Player&) = default;
  Player(std::shared_ptr<const Character> character, const PlayerOptions& options,
         std::shared_ptr<Workspace> workspace);

  struct Style {
    int playing = 0, waiting = -1;
    Moment moment;  // of the one that waits
  };

  // What a player has whose character has moves or styles.
  struct Extras {
    MoveTrack whole_body;
    UpperBody upper_body;
    std::shared_ptr<Player> rehearsal;  // plays ahead what would be shown; takes its state anew each time
    int policy = 0;                     // the number that the policy has in each style
    Style style;
  };

  void complete(const PlayerOptions& options);
  void make_extras(const PlayerOptions& options);
  void set_far_away(const PlayerOptions& options);
  void set_style(int style);
  double begin_style(const Control& control, double most);
  Control wanted(const Control& control) const;
  double cost_of_style(int style, const Control& wanted) const;
  MoveTrack& track_of(int move);
  static void check_step(const Control& control, double seconds);
  void go_on(const Control& control);
  void play(int fragment);
  void play_move(int part);
  void keep(const Vector2& faster);
  double advance(const Control& control, double most);
  double advance_by_policy(const Control& control, double most);
  double advance_by_move(double most);
  double begin_moves(const Control& control, double most);
  template <typename Cost>
  void plan(Moment& moment, const Control& control, bool (Player::*can)() const, const Cost& cost);
  template <typename Cost>
  bool is_due(MoveTrack& track, const Control& control, const Cost& cost);
  void imitate(const Player& other);
  bool is_stitched() const;
  bool can_begin_move() const;
  bool can_change_style() const;
  bool continue_move(const Control& control);
  void resume(const Control& control);
  void enter_best_class(const Control& wanted);
  void correct(const Control& control, double seconds);
  FeetAhead feet_ahead() const;
  void forget_markers();

  std::shared_ptr<const Character> character_;
  std::shared_ptr<Workspace> workspace_;
  RootGovernor governor_;
  Director director_;
  FragmentSelector selector_;
  Playback playback_;
  PoseCorrection correction_;
  Gaze gaze_;
  std::shared_ptr<Reaching> reaching_;        // its own; null in a crowd's and in a rehearsal
  std::shared_ptr<Extras> extras_;            // its own; null without moves and styles, and in a rehearsal
  std::shared_ptr<GroundFollower> follower_;  // its own; null without ground
  int entered_ = 0;
  int fragment_ = 0;
  bool far_away_ = false;
  Vector3 root_ = Vector3::Zero();  // as it is shown
};

}  // namespace fragmotion

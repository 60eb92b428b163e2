// SPDX-License-Identifier: MIT
#pragma once

#include "api/state_bytes.hpp"
#include "direct/make_way.hpp"
#include "direct/path_follower.hpp"
#include "direct/steering.hpp"
#include "feet/ground_follower.hpp"
#include "runtime/player.hpp"

namespace fragmotion {

/// What the next poses of a player depend on, with an archive of state_bytes.hpp: all that its parts keep from step to
/// step, but for what they are made with. It is a friend of theirs.
struct PlayerState {
  template <typename Archive>
  static void exchange(Archive& a, Player& player);
  template <typename Archive>
  static void exchange(Archive& a, PathFollower& follower);
  template <typename Archive>
  static void exchange(Archive& a, Steering& steering);
  template <typename Archive>
  static void exchange(Archive& a, WayRound& way_round);

  /// Which feet stand, as they are shown.
  static std::array<bool, 2> standing_feet(const Player& player) {
    const std::array<bool, 2>& stand = player.playback_.steps().stands;
    return {player.correction_.plants(0, stand[0]), player.correction_.plants(1, stand[1])};
  }

 private:
  // What of a style may be played, by numbers as Character::played() has them.
  struct Numbers {
    int style, first, last;
  };
  static Numbers all_of(const Character& character, int style) {
    const Character& c = character.in_style(style);
    return {style, 0, static_cast<int>(c.pool.fragments.size() + c.move_parts.size()) - 1};
  }
  static Numbers parts_of(const Character& character, int move) {
    const int first = character.number_of(move, MovePart::opening);
    return {0, first, first + kMoveParts - 1};
  }

  template <typename Archive>
  static void vector(Archive& a, Vector2& v, double most);
  template <typename Archive>
  static void vector(Archive& a, Vector3& v, double most);
  template <typename Archive>
  static void frame(Archive& a, CharacterFrame& frame);
  template <typename Archive>
  static void control(Archive& a, Control& control);
  template <typename Archive>
  static void approach(Archive& a, Approach& approach);
  template <typename Archive>
  static void footing(Archive& a, Footing& footing);
  template <typename Archive>
  static void exchange(Archive& a, CommandLimit& limit);
  template <typename Archive>
  static void exchange(Archive& a, Director& director, const Character& style);
  template <typename Archive>
  static void exchange(Archive& a, FragmentSelector& selector);
  template <typename Archive>
  static void exchange(Archive& a, Inertialization& inertialization);
  template <typename Archive>
  static void placed(Archive& a, Playback::Placed& placed, const Numbers& may_be);
  template <typename Archive>
  static void exchange(Archive& a, Playback& playback, int of_style, const Numbers& now);
  template <typename Archive>
  static void exchange(Archive& a, FootLock& lock);
  template <typename Archive>
  static void exchange(Archive& a, RootGovernor& governor);
  template <typename Archive>
  static void exchange(Archive& a, PoseCorrection& correction);
  template <typename Archive>
  static void exchange(Archive& a, Gaze& gaze);
  template <typename Archive>
  static void exchange(Archive& a, Reaching& reaching);
  template <typename Archive>
  static void exchange(Archive& a, Moment& moment);
  template <typename Archive>
  static int exchange(Archive& a, MoveTrack& track, bool upper_body);
  template <typename Archive>
  static int exchange(Archive& a, Player::Extras& extras);
  template <typename Archive>
  static void exchange(Archive& a, KnownGround& ground);
  template <typename Archive>
  static void exchange(Archive& a, FootOnGround& foot);
  template <typename Archive>
  static void exchange(Archive& a, HipsOnGround& hips);
  template <typename Archive>
  static void exchange(Archive& a, GroundFollower& follower);
};

}  // namespace fragmotion
